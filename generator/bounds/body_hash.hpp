#pragma once

#include <string>
#include <vector>

#include "graph/kernel.hpp"

namespace zonal {

/// Names the arithmetic of a kernel's printed body: its operations in order, constants as printed, whatever
/// values and kernel are called. 16 hexadecimal digits. `kernels`: those of the order, since the arithmetic
/// of `apply` begins in `prepare`.
std::string body_hash(const graph::Kernel& kernel, const std::vector<graph::Kernel>& kernels);

}  // namespace zonal
