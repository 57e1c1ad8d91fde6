#pragma once

#include <array>
#include <optional>
#include <vector>

#include "support/oracle.hpp"
#include "web/scene.hpp"

namespace zonal::web {

/// Where a pixel of the picture looks: the ball's normal and the view mirrored there, unit vectors, exact to
/// the last bits of long double. Nothing off the ball. Row 0 is the lowest.
struct Hit {
    oracle::Vector3 normal, mirrored;
};
std::optional<Hit> hit(int size, int column, int row);

/// What a pixel's colour weighs each coefficient of the turned light by: matte a_l y_i(n) + mirror y_i(r),
/// a_l the clamped cosine over pi, 1, 2/3, 1/4, 0 (Ramamoorthi and Hanrahan 2001, eq. 8).
std::vector<double> weights(const Scene& scene, int order, const Hit& hit);

/// The shader's rounding (tests/web/lit_sphere.frag), relative to sum_i |f'_i| W_i, where `sizes` gives W:
/// `weights` with every sum made of absolute values. Derived in the source.
double shading_error(int order);
std::vector<double> sizes(const Scene& scene, int order, const Hit& hit);

/// The pixel's colour by the definition, f(Q^T w) at both directions, with no rotation of coefficients and by
/// the oracle: exact. `to_light` is Q^T, row-major.
std::array<double, 3> colour_by_definition(const Scene& scene, int order, const oracle::Matrix3& to_light,
                                           const Hit& hit);

}  // namespace zonal::web
