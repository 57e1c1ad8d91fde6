#pragma once

#include <span>

#include "zonal/api.hpp"
#include "zonal/direction.hpp"
#include "zonal/rgb.hpp"

namespace zonal {

/// Evaluates the real orthonormal SH basis of the given order (1 to 20) in one direction.
/// direction : unit vector; not checked, other lengths give values of no meaning.
/// values    : order^2 values, index l(l+1)+m; z polar, no Condon-Shortley sign:
///             y_l^m = sqrt(2) K_l^m P_l^m(cos theta) cos(m phi) for m > 0, K_l^0 P_l(cos theta) for m = 0,
///             sqrt(2) K_l^|m| P_l^|m|(cos theta) sin(|m| phi) for m < 0, so y_1 = sqrt(3 / 4 pi) (y, z, x).
/// Errors    : zonal::Error when the order is out of range or the span has the wrong length.
/// Accuracy  : a few epsilons times order, at the poles too; no trigonometry.
/// Cost      : a handful of operations a value.
/// Source    : eq. 1 of Nowrouzezahrai et al.; the recurrences stand in src/light/basis.cpp.
ZONAL_API void evaluate_basis(int order, const Direction& direction, std::span<double> values);

/// The function f(w) = sum of coefficients[i] y_i(w), for one channel or three.
/// Shapes, preconditions and errors as above.
ZONAL_API double evaluate(int order, std::span<const double> coefficients, const Direction& direction);
ZONAL_API Rgb<double> evaluate(int order, std::span<const Rgb<double>> coefficients,
                               const Direction& direction);

}  // namespace zonal
