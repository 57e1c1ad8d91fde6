#pragma once

#include <vector>

#include "graph/kernel.hpp"
#include "kernels/rotation_scalars.hpp"

namespace zonal::kernels {

/// Columns with |n| above this many tenths of l are outer ones: dense_blocks.cpp says why.
inline constexpr int kInnerTenths = 7;

/// D_l as rotation scalars, row-major (2l+1)², for l = 0 … order-1: f'_l = D_l f_l.
std::vector<std::vector<graph::Value>> dense_blocks(graph::Kernel& kernel, const Matrix3& rows, int order);

}  // namespace zonal::kernels
