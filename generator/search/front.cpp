#include "search/front.hpp"

#include <algorithm>
#include <cmath>

namespace zonal::search {

bool is_better(const Solution& a, const Solution& b, const Objective& objective) {
    const double cost_a = a.score.cost(objective), cost_b = b.score.cost(objective);
    if (std::isinf(cost_a)) return false;
    if (std::isinf(cost_b) || std::abs(cost_a - cost_b) > 1e-6) return cost_a < cost_b;
    return turning_cost(directions_of(a.lobes)) < turning_cost(directions_of(b.lobes));
}

namespace {

bool is_dominated(const Score& a, const Score& b) {
    return b.nonzeros <= a.nonzeros && b.multiplications <= a.multiplications &&
           b.condition <= a.condition * (1 + 1e-9);
}

}  // namespace

void add_to_front(std::vector<Solution>& front, const Solution& solution) {
    const auto beats = [&](const Solution& other) { return is_dominated(solution.score, other.score); };
    if (std::ranges::any_of(front, beats)) return;
    std::erase_if(front, [&](const Solution& other) { return is_dominated(other.score, solution.score); });
    front.push_back(solution);
}

void sort_front(std::vector<Solution>& front) {
    std::ranges::stable_sort(front, {}, [](const Solution& s) { return s.score.nonzeros; });
}

}  // namespace zonal::search
