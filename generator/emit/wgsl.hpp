#pragma once

#include <vector>

#include "emit/file.hpp"
#include "emit/unit.hpp"

namespace zonal::emit {

/// Prints kernels as WGSL functions that take arrays and return one, FOLDER/KERNEL.wgsl. WGSL has no
/// overloads: every kernel of a signal has a second function, ..._rgb, on vec3<f32>, three channels.
std::vector<File> print_wgsl(const Unit& unit);

}  // namespace zonal::emit
