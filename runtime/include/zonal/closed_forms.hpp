#pragma once

#include <span>

#include "zonal/api.hpp"
#include "zonal/direction.hpp"
#include "zonal/rgb.hpp"

namespace zonal {

// What needs no rotation of SH vectors at all. Everywhere: order 1 to 20, order^2 coefficients, index
// l(l+1)+m, real orthonormal, no Condon-Shortley sign, z polar; a direction is a unit vector, not checked; a
// zonal::Error is thrown when the order is out of range or a span has the wrong length, outputs untouched.

/// The SH vector of a function that is symmetric about an axis, with that axis along `direction`.
/// zonal    : `order` values, z_l the coefficient of y_l^0 when the axis is z.
/// out      : may overlap `zonal`.
/// Accuracy : a few epsilons times order, relative to |z_l| in band l. Cost: evaluate_basis and a
///            multiplication a coefficient; a rotation costs several times that.
/// Source   : Nowrouzezahrai et al., eq. 3: f_lm = sqrt(4 pi / (2l+1)) z_l y_l^m(direction).
ZONAL_API void turn_zonal(int order, std::span<const double> zonal, const Direction& direction,
                          std::span<double> out);

/// What convolution with the clamped cosine max(0, cos theta) multiplies band l by: pi, 2 pi / 3, pi / 4, 0,
/// -pi / 24, 0, pi / 64 ...; zero for odd l above 1. Its zonal coefficient is sqrt((2l+1) / 4 pi) times that.
/// l        : at least 0, or zonal::Error. Accuracy: 2 l epsilons, relative.
/// Source   : Ramamoorthi and Hanrahan, An Efficient Representation for Irradiance Environment Maps, 2001;
///            Kirsch, Rotation of Low Order Spherical Harmonics, has l < 2.
ZONAL_API double clamped_cosine_factor(int l);

/// The SH vector of w -> max(0, direction . w): what a diffuse surface with that normal collects.
/// Source   : Kirsch (order 2), here of any order by eq. 3.
ZONAL_API void clamped_cosine(int order, const Direction& direction, std::span<double> out);

/// Irradiance of radiance `in`: out(n) = integral of max(0, n . w) in(w) over the sphere.
/// in, out  : may be the same span. A NaN or infinity stays in its coefficient, where the factor is zero too.
/// Accuracy : that of clamped_cosine_factor and one rounding.
ZONAL_API void irradiance(int order, std::span<const double> in, std::span<double> out);
ZONAL_API void irradiance(int order, std::span<const Rgb<double>> in, std::span<Rgb<double>> out);

/// Band 1 of any signal is one zonal lobe along `direction`: coefficient times y_1^0 about that axis.
struct LinearLobe {
    Direction direction;  ///< unit; z when band 1 is zero
    double coefficient;   ///< never negative
};

/// The lobe that is band 1 of the signal, exactly. Errors: also when order < 2.
/// Source   : Sloan, Luna, Snyder 2005, the optimal linear lobe.
ZONAL_API LinearLobe linear_lobe(int order, std::span<const double> signal);

/// A light from one direction: intensity times the impulse at `direction`, intensity y_l^m(direction).
template <class V>
struct DirectionalLight {
    Direction direction;
    V intensity;
};

/// The light along the signal's linear lobe whose intensity fits the signal best (least squares, all bands):
/// intensity = 4 pi f(direction) / order^2. In colour the lobe is that of the luminance (Rec. 709 weights).
/// The intensity may be negative. Errors: also when order < 2.
/// Source   : Sloan, Stupid Spherical Harmonics Tricks, 2008.
ZONAL_API DirectionalLight<double> dominant_light(int order, std::span<const double> signal);
ZONAL_API DirectionalLight<Rgb<double>> dominant_light(int order, std::span<const Rgb<double>> signal);

}  // namespace zonal
