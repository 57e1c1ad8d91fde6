#pragma once

#include <string>
#include <vector>

#include "emit/file.hpp"
#include "emit/unit.hpp"

namespace zonal::emit {

/// Prints kernels as C++17 headers, at most 100 columns, LF: zonal/FOLDER/KERNEL.hpp; what they share,
/// zonal/kernel_support.hpp; and where the unit wants all of them zonal/FOLDER.hpp, which includes each.
/// Throws std::logic_error when a kernel could not be called in place.
std::vector<File> print_cpp(const Unit& unit);

/// The kernels, by plain name, that it leaves out of all of them: straight lines that compilers take long
/// for.
std::vector<std::string> kernels_left_out(const Unit& unit);

}  // namespace zonal::emit
