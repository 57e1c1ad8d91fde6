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
#include "kernels/contraction.hpp"
#include "kernels/dense_blocks.hpp"

namespace zonal::kernels {

namespace {

using graph::Kernel;
using graph::Kind;
using graph::Value;

/// Dense bands above this one need more instructions a vector than any form of zxzxz.
constexpr int kLargestPlannedDenseBand = 3;
constexpr int kLargestBandPlannedTogether = 5;

/// Builds bands one by one; what they share is made when first asked for.
class SignalBuilder {
  public:
    explicit SignalBuilder(int order) : order_(order) {
        kernel_.inputs = {rotation_array(), {"f", Kind::signal, order * order, "index l(l+1)+m"}};
        kernel_.output = {"out", Kind::signal, order * order, "index l(l+1)+m"};
        rows_ = rotation_rows(kernel_);
    }

    void build_band(int l, const BandPlan& plan) {
        switch (plan.method) {
            case BandMethod::contraction:
                return build_contraction_band(kernel_, rows_, l, Reading::by_trace);
            case BandMethod::direct_contraction:
                return build_contraction_band(kernel_, rows_, l, Reading::direct);
            case BandMethod::proper_contraction:
                kernel_.needs_proper_rotation = true;
                return build_proper_contraction_band_2(kernel_, rows_);
            case BandMethod::zxzxz:
                kernel_.needs_proper_rotation = true;
                if (euler_.empty()) euler_.push_back(euler_scalars(kernel_, rows_, order_));
                return build_zxzxz_band(kernel_, euler_.front(), l, plan.forms);
            case BandMethod::dense:
                return build_dense_band(l);
        }
    }

    Kernel take() {
        kernel_.store(0, kernel_.input(1, 0), 0);
        return graph::optimize(std::move(kernel_));
    }

  private:
    void build_dense_band(int l) {
        if (static_cast<int>(blocks_.size()) <= l) blocks_ = dense_blocks(kernel_, rows_, l + 1);
        kernel_.graph.set_scope(fmt::format("b{}", l));
        const int size = 2 * l + 1;
        for (int i = 0; i < size; ++i) {
            Value sum{&kernel_.graph, kernel_.graph.constant(0)};
            for (int j = 0; j < size; ++j) sum = sum + blocks_[l][i * size + j] * kernel_.input(1, l * l + j);
            kernel_.store(l * l + i, sum, l);
        }
    }

    int order_;
    Kernel kernel_;
    Matrix3 rows_;
    std::vector<EulerScalars> euler_;  ///< none or one
    std::vector<std::vector<Value>> blocks_;
};

int weighted(const graph::Cost& cost, const Workload& workload) {
    constexpr int kWeightOfDivision = 8;
    const auto of = [](const graph::Counts& c) {
        return c.mul + c.add + c.fma + kWeightOfDivision * c.other;
    };
    return of(cost.per_rotation) + workload.vectors * of(cost.per_vector);
}

std::vector<BandPlan> ways(int l) {
    std::vector<BandPlan> all;
    if (l <= kLargestContractionBand) all.push_back({BandMethod::contraction, {}});
    if (l == 1) return all;  // a vector: nothing beats the product with R
    if (l <= kLargestContractionBand) all.push_back({BandMethod::direct_contraction, {}});
    if (l == 2) all.push_back({BandMethod::proper_contraction, {}});
    if (l <= kLargestPlannedDenseBand) all.push_back({BandMethod::dense, {}});
    for (const BandForms& forms : band_forms()) all.push_back({BandMethod::zxzxz, forms});
    return all;
}

bool needs_proper_rotation(const BandPlan& plan) {
    return plan.method == BandMethod::zxzxz || plan.method == BandMethod::proper_contraction;
}

const char* name_of(PartForm form) {
    switch (form) {
        case PartForm::transform:
            return "transform";
        case PartForm::update:
            return "update";
        case PartForm::scaled:
            return "scaled";
        case PartForm::sheared:
            return "sheared";
        case PartForm::reflect:
            return "reflect";
    }
    return "";
}

}  // namespace

std::string name_of(const BandPlan& plan) {
    switch (plan.method) {
        case BandMethod::contraction:
            return "contraction";
        case BandMethod::direct_contraction:
            return "contraction, read directly";
        case BandMethod::proper_contraction:
            return "contraction for det R = +1";
        case BandMethod::dense:
            return "dense";
        case BandMethod::zxzxz:
            return fmt::format("zxzxz, even m {}, odd m {}", name_of(plan.forms.even),
                               name_of(plan.forms.odd));
    }
    return "";
}

int weight(const Kernel& kernel, const Workload& workload) {
    return weighted(graph::count_operations(kernel), workload);
}

Kernel build_plan(int order, const Plan& plan) {
    SignalBuilder builder(order);
    for (std::size_t band = 0; band < plan.size(); ++band)
        builder.build_band(static_cast<int>(band) + 1, plan[band]);
    return builder.take();
}

bool is_fit_for(const BandPlan& plan, int order, const Workload& workload) {
    // Shears wait for one another, rows of a product do not: with as many instructions a vector but less
    // set-up, packs of many vectors took 5 to 7 % longer by shears, and three channels of order 8 took 8 %.
    constexpr int kMostVectorsSheared = 3, kLastOrderSheared = 6;
    const bool is_sheared = plan.forms.even == PartForm::sheared || plan.forms.odd == PartForm::sheared;
    if (is_sheared && (workload.vectors > kMostVectorsSheared || order > kLastOrderSheared)) return false;
    return !workload.takes_mirrors || !needs_proper_rotation(plan);
}

std::vector<Alternative> alternatives(int order, int l) {
    std::vector<Alternative> all;
    for (const BandPlan& plan : ways(l)) {
        SignalBuilder builder(order);
        builder.build_band(l, plan);
        // The scalars of a band lie in its scope, those of dense blocks in their own; those of the angles are
        // shared.
        const Kernel kernel = builder.take();
        graph::Cost cost = graph::count_operations(kernel, fmt::format("b{}", l));
        if (plan.method == BandMethod::dense)
            cost.per_rotation = cost.per_rotation + graph::count_operations(kernel, "d").per_rotation;
        all.push_back({plan, cost});
    }
    return all;
}

Planner::Planner(int order) : order_(order) {
    for (int l = 1; l < order; ++l) alternatives_.push_back(alternatives(order, l));
}

/// The ways of every band, those left out that weigh more than the best of their method and all that scalars
/// shared with other bands could save.
std::vector<std::vector<BandPlan>> Planner::candidates(const Workload& workload) const {
    constexpr int kMostSaved = 6;
    std::vector<std::vector<BandPlan>> candidates;
    for (std::vector<Alternative> all : alternatives_) {
        std::erase_if(all, [&](const Alternative& a) { return !is_fit_for(a.plan, order_, workload); });
        std::stable_sort(all.begin(), all.end(), [&](const Alternative& a, const Alternative& b) {
            return weighted(a.cost, workload) < weighted(b.cost, workload);
        });
        std::map<BandMethod, int> least;
        candidates.emplace_back();
        for (const Alternative& a : all) {
            const int w = weighted(a.cost, workload);
            least.try_emplace(a.plan.method, w);
            if (w <= least[a.plan.method] + kMostSaved) candidates.back().push_back(a.plan);
        }
        // Above the low bands only dense blocks take mirrors.
        if (candidates.back().empty()) candidates.back().push_back({BandMethod::dense, {}});
    }
    return candidates;
}

int Planner::weight_of(const Plan& plan, const Workload& workload) {
    const auto [known, is_new] = costs_.try_emplace(plan);
    if (is_new) known->second = graph::count_operations(build_plan(order_, plan));
    return weighted(known->second, workload);
}

Plan Planner::cheapest(const Workload& workload) {
    const std::vector<std::vector<BandPlan>> candidates = this->candidates(workload);
    // Low bands together: from one method for all of them that know it, one band at a time is changed while
    // that helps. Higher bands have zxzxz only and share nothing but its angles: each by itself.
    const auto low_bands = static_cast<std::size_t>(std::min(order_ - 1, kLargestBandPlannedTogether));
    std::optional<Plan> best;
    int least = 0;
    for (const BandMethod method : {BandMethod::contraction, BandMethod::zxzxz}) {
        Plan plan;
        for (std::size_t band = 0; band < low_bands; ++band) {
            const auto preferred = std::find_if(candidates[band].begin(), candidates[band].end(),
                                                [&](const BandPlan& way) { return way.method == method; });
            plan.push_back(preferred == candidates[band].end() ? candidates[band].front() : *preferred);
        }
        int reached = weight_of(plan, workload);
        for (bool is_better = true; is_better;) {
            is_better = false;
            for (std::size_t band = 0; band < low_bands; ++band) {
                for (const BandPlan& way : candidates[band]) {
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
