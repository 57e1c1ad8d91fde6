#pragma once

#include <string>

#include "emit/unit.hpp"

namespace zonal::emit {

/// Prints a unit as one C++17 header, at most 100 columns, LF. Throws std::logic_error when a kernel could
/// not be called in place.
std::string print_cpp(const Unit& unit);

}  // namespace zonal::emit
