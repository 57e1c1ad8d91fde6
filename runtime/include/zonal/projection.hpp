#pragma once

#include <functional>
#include <span>
#include <vector>

#include "zonal/api.hpp"
#include "zonal/direction.hpp"
#include "zonal/environment_map.hpp"
#include "zonal/rgb.hpp"
#include "zonal/rotation.hpp"

namespace zonal {

/// Projects a map onto the SH basis: order^2 coefficients, index l(l+1)+m, of the integral of map times
/// y_l^m. The map is taken as constant over each texel and y_l^m is integrated over the texel exactly (to
/// rounding): so a constant map of 1 gives sqrt(4 pi) and zeros, and texels that shrink towards the poles
/// weigh what they should. A smooth function sampled at texel centres is recovered up to the square of the
/// texel's size, l^2 (pi / height)^2.
///
/// Preconditions : order 1 to 20, at least `order` rows, width = 2 height.
/// Errors        : zonal::Error when one of these fails.
/// Cost          : about 4 order additions and multiplications a channel and texel.
ZONAL_API std::vector<Rgb<double>> project(int order, const EnvironmentMap& map);

/// Projects a function given by its values at unit vectors; exact to rounding when none of its bands l
/// reaches `order`. Calls the function 32 order^2 times. Errors: zonal::Error when the order is not 1 to 20.
ZONAL_API std::vector<Rgb<double>> project(int order,
                                           const std::function<Rgb<double>(const Direction&)>& function);

/// The map of f(w) = sum of coefficients[i] y_i(w), sampled at texel centres in double; values may be
/// negative. Errors: zonal::Error when the order is not 1 to 20, `coefficients` is not of length order^2, or
/// height < 1.
ZONAL_API EnvironmentMap reconstruct(int order, std::span<const Rgb<double>> coefficients, int height);

/// The same of f(R^T w): what a rotation of the coefficients has to give, with no rotation of coefficients.
ZONAL_API EnvironmentMap reconstruct_rotated(int order, std::span<const Rgb<double>> coefficients,
                                             const RotationMatrix<double>& rotation, int height);

}  // namespace zonal
