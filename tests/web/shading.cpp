// The picture of tests/web/lit_sphere.frag in high precision, and how far that shader may be from it.
//
// Rounding, u = 2^-24, by Vulkan's "Precision of Individual Operations", which SwiftShader under ANGLE keeps:
// + - * are correctly rounded (to nearest here; a b + c may be fused, which is no worse), a / b is within 2.5
// ULP and inversesqrt within 2, so sqrt, which may be one over the other, within 4.5 ULP = 9 u.
//   directions : y, z, y^2 + z^2 and 1 - 2 (y^2 + z^2) are exact (size is a power of two); the normal's x has
//                the root's 9 u, the mirrored y and z one product more: 10 u
//   basis      : of degree at most 3 in these: 30 u; its own longest way from a coordinate to the value is
//                the constant, square, times 3, minus, times coordinate, times constant: 6 u
//   weight     : a_l, times matte, times basis, plus: 4 u
//   sum        : one product, at most N^2 additions
// Every count is relative to the same expression with all its terms made positive.

#include "web/shading.hpp"

#include <cmath>

namespace zonal::web {
namespace {

using Real = oracle::Real;

int band_of(int i) { return static_cast<int>(std::sqrt(i)); }
constexpr std::array kCosineFactors = {1.0, 2.0 / 3.0, 0.25, 0.0};

/// The basis as the shader has it, up to order 4, with x, y, z >= 0 and every minus made a plus.
std::array<double, 16> positive_basis(const oracle::Vector3& direction) {
    const auto x = static_cast<double>(std::abs(direction[0]));
    const auto y = static_cast<double>(std::abs(direction[1]));
    const auto z = static_cast<double>(std::abs(direction[2]));
    const double second = x * x + y * y;
    return {0.28209479177,
            0.48860251190 * y,
            0.48860251190 * z,
            0.48860251190 * x,
            1.09254843059 * x * y,
            1.09254843059 * y * z,
            0.31539156525 * (3 * z * z + 1),
            1.09254843059 * x * z,
            0.54627421529 * second,
            0.59004358992 * y * (3 * x * x + y * y),
            2.89061144264 * x * y * z,
            0.45704579946 * y * (5 * z * z + 1),
            0.37317633259 * z * (5 * z * z + 3),
            0.45704579946 * x * (5 * z * z + 1),
            1.44530572132 * z * second,
            0.59004358992 * x * (x * x + 3 * y * y)};
}

oracle::Vector3 turned(const oracle::Matrix3& matrix, const oracle::Vector3& v) {
    oracle::Vector3 result{};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) result[i] += matrix[3 * i + j] * v[j];
    }
    return result;
}

}  // namespace

std::optional<Hit> hit(int size, int column, int row) {
    const Real y = static_cast<Real>(2 * column + 1 - size) / size;
    const Real z = static_cast<Real>(2 * row + 1 - size) / size;
    const Real square = y * y + z * z;
    if (square >= 1) return std::nullopt;
    const Real x = std::sqrt(1 - square);
    return Hit{.normal = {x, y, z}, .mirrored = {1 - 2 * square, 2 * x * y, 2 * x * z}};
}

std::vector<double> weights(const Scene& scene, int order, const Hit& hit) {
    const std::vector<Real> normal = oracle::basis(order, hit.normal);
    const std::vector<Real> mirrored = oracle::basis(order, hit.mirrored);
    std::vector<double> result;
    for (int i = 0; i < order * order; ++i) {
        result.push_back(static_cast<double>(scene.matte * kCosineFactors.at(band_of(i)) * normal[i] +
                                             scene.mirror * mirrored[i]));
    }
    return result;
}

double shading_error(int order) {
    const double roundings = 30 + 6 + 4 + 1 + order * order;
    const double small = roundings * std::ldexp(1.0, -24);
    return small / (1 - small);
}

std::vector<double> sizes(const Scene& scene, int order, const Hit& hit) {
    const auto normal = positive_basis(hit.normal);
    const auto mirrored = positive_basis(hit.mirrored);
    std::vector<double> result;
    for (int i = 0; i < order * order; ++i) {
        result.push_back(scene.matte * kCosineFactors.at(band_of(i)) * normal[i] +
                         scene.mirror * mirrored[i]);
    }
    return result;
}

std::array<double, 3> colour_by_definition(const Scene& scene, int order, const oracle::Matrix3& to_light,
                                           const Hit& hit) {
    const Hit seen_by_light{.normal = turned(to_light, hit.normal),
                            .mirrored = turned(to_light, hit.mirrored)};
    const std::vector<double> weight = weights(scene, order, seen_by_light);
    std::array<double, 3> colour{};
    for (int i = 0; i < order * order; ++i) {
        const Rgb<double> f = scene.light[i].cast<double>();
        colour[0] += weight[i] * f.r;
        colour[1] += weight[i] * f.g;
        colour[2] += weight[i] * f.b;
    }
    return colour;
}

}  // namespace zonal::web
