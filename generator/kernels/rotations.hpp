#pragma once

#include <vector>

#include "graph/kernel.hpp"
#include "kernels/planner.hpp"

namespace zonal::kernels {

/// What the kernels of an order plan for: one vector, three of one rotation, many of one rotation.
struct OrderPlans {
    Plan one, channels, many;
};
OrderPlans plan_order(int order);

/// The kernels of an order that need no lobe table, optimized:
/// - `rotate_channels`: the fewest instructions for three vectors of one rotation, where that is another
///   kernel;
/// - `rotate_fewest`: the same for one vector; a signal value of several channels goes to `rotate_channels`;
/// - `rotate_tensor`: products and sums alone, where every band can be contracted;
/// - `prepare`, `apply`: the cheapest for many vectors of one rotation, in its two halves;
/// - `rotate_accurate`: contractions read directly where every band has one, else dense blocks, built and
///   applied;
/// - `blocks`: dense blocks.
std::vector<graph::Kernel> build_rotations(int order, const OrderPlans& plans);

inline std::vector<graph::Kernel> build_rotations(int order) {
    return build_rotations(order, plan_order(order));
}

}  // namespace zonal::kernels
