#pragma once

#include <string>

#include "emit/unit.hpp"

namespace zonal::emit {

/// Prints a unit as GLSL functions for desktop versions from 4.50 and ES 3.00 alike: no #version, no globals,
/// no fma, no precise. Every kernel of a signal has an overload on vec3, three channels.
std::string print_glsl(const Unit& unit);

/// The statements of a kernel; signal values are vec3 where it `has_channels`.
std::string print_glsl_statements(const graph::Kernel& kernel, bool has_channels, int indentation);

/// One of them: its comment and its functions.
std::string print_glsl_kernel(const Unit& unit, const graph::Kernel& kernel);

}  // namespace zonal::emit
