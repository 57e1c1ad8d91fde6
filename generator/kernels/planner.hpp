#pragma once

#include <map>
#include <vector>

#include "graph/counts.hpp"
#include "graph/kernel.hpp"
#include "kernels/band_methods.hpp"

namespace zonal::kernels {

/// What one call has to do; decides which kernel is the cheapest.
struct Workload {
    int vectors = 1;             ///< that share a rotation
    bool takes_mirrors = false;  ///< determinant -1 must come out right without the caller's help
};

/// How every band from 1 on is rotated: entry l - 1 belongs to band l.
using Plan = std::vector<const BandMethod*>;

/// Instructions for a workload, a division or root counted as eight: what `cheapest_plan` minimizes.
int weight(const graph::Kernel& kernel, const Workload& workload);

/// Rotates the bands that are planned: f' from the rotation (input 0) and f (input 1), optimized. Name and
/// texts are the caller's.
graph::Kernel build_plan(int order, const Plan& plan);

/// Whether a plan of an order for a workload may have it.
bool is_fit_for(const BandMethod& method, int order, const Workload& workload);

/// One way to rotate a band, and what it alone costs (set-up that bands share left out).
struct Alternative {
    const BandMethod* method = nullptr;
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
    std::vector<Plan> candidates(const Workload& workload) const;
    int weight_of(const Plan& plan, const Workload& workload);

    int order_;
    std::vector<std::vector<Alternative>> alternatives_;  ///< of bands 1 … order-1
    std::map<Plan, graph::Cost> costs_;                   ///< of the plans that were weighed
};

/// The same for one workload alone.
inline Plan cheapest_plan(int order, const Workload& workload) { return Planner(order).cheapest(workload); }

}  // namespace zonal::kernels
