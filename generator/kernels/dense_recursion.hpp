#pragma once

#include "graph/kernel.hpp"

namespace zonal::kernels {

/// The recursion of dense_blocks.hpp as C++ loops: what `blocks` is from order 11 on, where straight lines
/// take compilers minutes.
graph::Loops loops_of_blocks(int order);

/// The same, each block multiplied with its band as soon as it is made: `rotate_accurate`.
graph::Loops loops_of_rotation(int order);

}  // namespace zonal::kernels
