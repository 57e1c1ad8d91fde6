// Chooses, per band and for a workload, the cheapest of the exact methods.
//
// Bands are independent but for the set-up that zxzxz bands share. So the forms of a band are compared by
// what the band alone adds, and the methods of the low bands, where contraction rivals zxzxz, by the weight
// of the whole order.
#include "kernels/planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <utility>

#include "graph/passes.hpp"

namespace zonal::kernels {

namespace {

using graph::Kernel;

constexpr int kLargestBandPlannedTogether = 5;

int weighted(const graph::Cost& cost, const Workload& workload) {
    constexpr int kWeightOfDivision = 8;
    const auto of = [](const graph::Counts& c) {
        return c.mul + c.add + c.fma + kWeightOfDivision * c.other;
    };
    return of(cost.per_rotation) + workload.vectors * of(cost.per_vector);
}

void build_band(RotationBuilder& builder, int l, const BandMethod& method) {
    if (!method.takes_mirrors) builder.kernel.needs_proper_rotation = true;
    method.build(builder, l);
}

Kernel take(RotationBuilder& builder) {
    builder.kernel.store(0, builder.kernel.input(1, 0), 0);
    return graph::optimize(std::move(builder.kernel));
}

}  // namespace

int weight(const Kernel& kernel, const Workload& workload) {
    return weighted(graph::count_operations(kernel), workload);
}

Kernel build_plan(int order, const Plan& plan) {
    RotationBuilder builder(order);
    for (std::size_t band = 0; band < plan.size(); ++band)
        build_band(builder, static_cast<int>(band) + 1, *plan[band]);
    return take(builder);
}

bool is_fit_for(const BandMethod& method, int order, const Workload& workload) {
    // Shears wait for one another, rows of a product do not: with as many instructions a vector but less
    // set-up, packs of many vectors took 5 to 7 % longer by shears, and three channels of order 8 took 8 %.
    constexpr int kMostVectorsChained = 3, kLastOrderChained = 6;
    if (method.is_chain && (workload.vectors > kMostVectorsChained || order > kLastOrderChained))
        return false;
    return !workload.takes_mirrors || method.takes_mirrors;
}

std::vector<Alternative> alternatives(int order, int l) {
    std::vector<Alternative> all;
    for (const BandMethod& method : band_methods()) {
        if (l < method.first_band || l > method.last_band) continue;
        RotationBuilder builder(order);
        build_band(builder, l, method);
        // The scalars of a band lie in its scope or the method's; those of the angles are shared.
        const Kernel kernel = take(builder);
        graph::Cost cost = graph::count_operations(kernel, fmt::format("b{}", l));
        if (!method.scalars.empty())
            cost.per_rotation =
                cost.per_rotation + graph::count_operations(kernel, method.scalars).per_rotation;
        all.push_back({&method, cost});
    }
    return all;
}

Planner::Planner(int order) : order_(order) {
    for (int l = 1; l < order; ++l) alternatives_.push_back(alternatives(order, l));
}

/// The ways of every band, those left out that weigh more than the best of their method and all that scalars
/// shared with other bands could save.
std::vector<Plan> Planner::candidates(const Workload& workload) const {
    constexpr int kMostSaved = 6;
    std::vector<Plan> candidates;
    for (std::vector<Alternative> all : alternatives_) {
        std::erase_if(all, [&](const Alternative& a) { return !is_fit_for(*a.method, order_, workload); });
        std::stable_sort(all.begin(), all.end(), [&](const Alternative& a, const Alternative& b) {
            return weighted(a.cost, workload) < weighted(b.cost, workload);
        });
        std::map<std::string, int> least;
        candidates.emplace_back();
        for (const Alternative& a : all) {
            const int w = weighted(a.cost, workload);
            least.try_emplace(a.method->family, w);
            if (w <= least[a.method->family] + kMostSaved) candidates.back().push_back(a.method);
        }
        // Above the low bands only dense blocks take mirrors.
        if (candidates.back().empty()) candidates.back().push_back(&band_method("dense"));
    }
    return candidates;
}

int Planner::weight_of(const Plan& plan, const Workload& workload) {
    const auto [known, is_new] = costs_.try_emplace(plan);
    if (is_new) known->second = graph::count_operations(build_plan(order_, plan));
    return weighted(known->second, workload);
}

Plan Planner::cheapest(const Workload& workload) {
    const std::vector<Plan> candidates = this->candidates(workload);
    // Low bands together: from one method for all of them that know it, one band at a time is changed while
    // that helps. Higher bands have zxzxz only and share nothing but its angles: each by itself.
    const auto low_bands = static_cast<std::size_t>(std::min(order_ - 1, kLargestBandPlannedTogether));
    std::optional<Plan> best;
    int least = 0;
    for (const char* family : {"contraction", "zxzxz"}) {
        Plan plan;
        for (std::size_t band = 0; band < low_bands; ++band) {
            const auto preferred = std::ranges::find(candidates[band], family, &BandMethod::family);
            plan.push_back(preferred == candidates[band].end() ? candidates[band].front() : *preferred);
        }
        int reached = weight_of(plan, workload);
        for (bool is_better = true; is_better;) {
            is_better = false;
            for (std::size_t band = 0; band < low_bands; ++band) {
                for (const BandMethod* way : candidates[band]) {
                    Plan changed = plan;
                    changed[band] = way;
                    const int w = weight_of(changed, workload);
                    if (w >= reached) continue;
                    reached = w;
                    plan = changed;
                    is_better = true;
                }
            }
        }
        if (!best || reached < least) {
            best = plan;
            least = reached;
        }
    }
    for (std::size_t band = low_bands; band < candidates.size(); ++band)
        best->push_back(candidates[band].front());
    return *best;
}

}  // namespace zonal::kernels
