#pragma once

#include <vector>

#include "graph/kernel.hpp"
#include "kernels/lobes.hpp"

namespace zonal::kernels {

/// Every kernel of an order, optimized, in the order they are emitted; without lobes (null) those that need
/// none. Adding a method is one line here.
std::vector<graph::Kernel> build_order(int order, const LobeSet* lobes);

}  // namespace zonal::kernels
