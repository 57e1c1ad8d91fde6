#pragma once

#include <string>
#include <vector>

#include "emit/file.hpp"
#include "emit/unit.hpp"

namespace zonal::emit {

/// Prints kernels as GLSL functions for desktop versions from 4.50 and ES 3.00 alike, FOLDER/KERNEL.glsl: no
/// #version, no globals, no fma, no precise, highp. Every kernel of a signal has an overload on vec3, three
/// channels. A file compiles alone, and any of them may follow each other, the same one twice too.
std::vector<File> print_glsl(const Unit& unit);

/// The statements of a kernel; signal values are vec3 where it `has_channels`.
std::string print_glsl_statements(const graph::Kernel& kernel, bool has_channels, int indentation);

/// One of them: its comment and its functions.
std::string print_glsl_kernel(const Unit& unit, const graph::Kernel& kernel);

/// Text that a shader reads once, however often it stands in it. `name` is of that text alone.
std::string glsl_once(const std::string& name, const std::string& text);

}  // namespace zonal::emit
