#pragma once

#include <map>

#include "kernels/order_kernels.hpp"

namespace zonal {

/// The kernels of an order from its committed tables, built at the first call: it takes seconds at high
/// orders.
inline const OrderKernels& built_order(int order) {
    static std::map<int, OrderKernels> built;
    const auto found = built.find(order);
    return found != built.end() ? found->second
                                : built.emplace(order, build_order_kernels(order)).first->second;
}

}  // namespace zonal
