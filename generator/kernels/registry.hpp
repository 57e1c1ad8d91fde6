#pragma once

#include <vector>

#include "graph/kernel.hpp"
#include "kernels/lobes.hpp"
#include "kernels/rotations.hpp"

namespace zonal::kernels {

/// Band 2 is the first whose lobes can be chosen.
inline constexpr int kSmallestLobeOrder = 3;

/// The searched lobes of an order, as far as there are any.
struct OrderLobeSets {
    const LobeSet* shared = nullptr;
    const LobeSet* turned = nullptr;    ///< those of `rotate_zhf`, if not the shared ones
    const LobeSet* per_band = nullptr;  ///< only beside shared ones
};

/// Every kernel of an order, optimized, in the order they are emitted: those of `rotate`; lobe kernels where
/// there are lobes, and of per-band lobes those that cost less; and the ring's as variant `stable`. Adding a
/// method is one line here.
std::vector<graph::Kernel> build_order(int order, const OrderPlans& plans, const OrderLobeSets& lobes);

/// The same where the plans are of no further interest.
inline std::vector<graph::Kernel> build_order(int order, const OrderLobeSets& lobes) {
    return build_order(order, plan_order(order), lobes);
}

}  // namespace zonal::kernels
