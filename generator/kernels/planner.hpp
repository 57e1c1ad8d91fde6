#pragma once

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

/// The combination of methods whose whole kernel has the least weight, set-up that bands share counted once.
Plan cheapest_plan(int order, const Workload& workload);

/// One way to turn a band, and what it alone costs (set-up that bands share left out).
struct Alternative {
    BandPlan plan;
    graph::Cost cost;
};
std::vector<Alternative> alternatives(int order, int l);

}  // namespace zonal::kernels
