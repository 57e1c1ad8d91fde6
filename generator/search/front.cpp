#include "search/front.hpp"

#include <cmath>

namespace zonal::search {

bool is_better(const Solution& a, const Solution& b, const Objective& objective) {
    const double cost_a = a.score.cost(objective), cost_b = b.score.cost(objective);
    if (std::isinf(cost_a)) return false;
    if (std::isinf(cost_b) || std::abs(cost_a - cost_b) > 1e-6) return cost_a < cost_b;
    return turning_cost(directions_of(a.lobes)) < turning_cost(directions_of(b.lobes));
}

bool is_beaten(const Score& a, const Score& b) {
    return b.nonzeros <= a.nonzeros && b.multiplications <= a.multiplications &&
           b.condition <= a.condition * (1 + 1e-9);
}

}  // namespace zonal::search
