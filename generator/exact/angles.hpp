#pragma once

#include <string>
#include <string_view>

#include "exact/matrix.hpp"

namespace zonal::exact {

/// Value at 50 digits of a closed form: numbers, `pi`, `sqrt(…)`, `acos(…)`, `+ - * /`, parentheses; nothing
/// else. "acos(sqrt((15+2*sqrt(30))/35))" is an example, a plain decimal another, with an
/// exponent or without.
/// Throws std::invalid_argument that quotes the text and the place it could not read.
Real evaluate_closed_form(std::string_view text);

/// 50 significant digits.
std::string decimal_text(const Real& value);

/// The unit direction at two angles in radians; a component below 1e-45 is an exact zero.
Direction<Real> direction_of(const Real& theta, const Real& phi);

}  // namespace zonal::exact
