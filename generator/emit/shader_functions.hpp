#pragma once

#include <string>
#include <vector>

#include "emit/file.hpp"
#include "emit/unit.hpp"

namespace zonal::emit {

/// What languages of shaders with C's functions, overloads and preprocessor call their types and functions.
struct ShaderDialect {
    std::string ending;     ///< of files
    std::string scalar;     ///< of 32 bits, whatever the default precision is
    std::string vector;     ///< three of them
    std::string to_bits;    ///< function from a float to an unsigned integer
    std::string from_bits;  ///< and back
};

/// Prints kernels as functions, FOLDER/KERNEL.ENDING: no globals, no fused operations. Every kernel of a
/// signal has an overload on vectors of three channels. A file compiles alone, and any of them may follow
/// each other, the same one twice too.
std::vector<File> print_shader_functions(const Unit& unit, const ShaderDialect& dialect);

/// The comment and the functions of one kernel.
std::string print_shader_kernel(const Unit& unit, const graph::Kernel& kernel, const ShaderDialect& dialect);

/// The statements of a kernel; signal values are vectors where it `has_channels`.
std::string print_shader_statements(const graph::Kernel& kernel, const ShaderDialect& dialect,
                                    bool has_channels, int indentation);

/// Text that a shader reads once, however often it stands in it. `name` is of that text alone.
std::string shader_once(const std::string& name, const std::string& text);

}  // namespace zonal::emit
