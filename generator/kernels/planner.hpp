#pragma once

#include <compare>
#include <map>
#include <string>
#include <vector>

#include "graph/counts.hpp"
#include "graph/kernel.hpp"
#include "kernels/zxzxz.hpp"

namespace zonal::kernels {

/// What one call has to do; decides which kernel is the cheapest.
struct Workload {
    int vectors = 1;             ///< that share a rotation
    bool takes_mirrors = false;  ///< determinant -1 must come out right without the caller's help
};

enum class BandMethod { contraction, direct_contraction, proper_contraction, zxzxz, dense };

/// How one band is turned.
struct BandPlan {
    BandMethod method = BandMethod::contraction;
    BandForms forms;  ///< zxzxz only
    friend auto operator<=>(const BandPlan&, const BandPlan&) = default;
};

/// How every band from 1 on is turned: entry l - 1 belongs to band l.
using Plan = std::vector<BandPlan>;

/// "contraction", "zxzxz, even update, odd transform", …
std::string name_of(const BandPlan& plan);

/// Instructions for a workload, a division or root counted as eight: what `cheapest_plan` minimizes.
int weight(const graph::Kernel& kernel, const Workload& workload);

/// Turns the bands that are planned: f' from the rotation (input 0) and f (input 1), optimized. Name and
/// texts are the caller's.
graph::Kernel build_plan(int order, const Plan& plan);

/// Whether a plan of an order for a workload may turn a band so.
bool is_fit_for(const BandPlan& plan, int order, const Workload& workload);

/// One way to turn a band, and what it alone costs (set-up that bands share left out).
struct Alternative {
    BandPlan plan;
    graph::Cost cost;
};
std::vector<Alternative> alternatives(int order, int l);

/// Plans the workloads of an order; what they have in common is built and counted once.
class Planner {
  public:
    explicit Planner(int order);

    /// The combination of methods whose whole kernel has the least weight, set-up that bands share counted
    /// once.
    Plan cheapest(const Workload& workload);

  private:
    std::vector<std::vector<BandPlan>> candidates(const Workload& workload) const;
    int weight_of(const Plan& plan, const Workload& workload);

    int order_;
    std::vector<std::vector<Alternative>> alternatives_;  ///< of bands 1 … order-1
    std::map<Plan, graph::Cost> costs_;                   ///< of the plans that were weighed
};

/// The same for one workload alone.
inline Plan cheapest_plan(int order, const Workload& workload) { return Planner(order).cheapest(workload); }

}  // namespace zonal::kernels
