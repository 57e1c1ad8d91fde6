#pragma once

#include <string>

#include "emit/unit.hpp"

namespace zonal::emit {

/// Prints a unit as WGSL functions that take arrays and return one. WGSL has no overloads: every kernel of a
/// signal has a second function, ..._rgb, on vec3<f32>, three channels.
std::string print_wgsl(const Unit& unit);

}  // namespace zonal::emit
