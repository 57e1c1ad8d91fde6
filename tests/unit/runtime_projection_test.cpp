#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "zonal/basis.hpp"
#include "zonal/eigen.hpp"
#include "zonal/error.hpp"
#include "zonal/projection.hpp"

namespace {

using zonal::Rgb;

constexpr double kPi = std::numbers::pi;

zonal::EnvironmentMap constant_map(int height) {
    zonal::EnvironmentMap map = zonal::black_map(height);
    for (auto& texel : map.texels) texel = {1, 1, 1};
    return map;
}

std::vector<Rgb<double>> unit_coefficient(int order, std::size_t index) {
    std::vector<Rgb<double>> coefficients(static_cast<std::size_t>(order) * order);
    coefficients[index] = {1, -2, 3};
    return coefficients;
}

/// Bound of |projection of samples of y_l^m - exact| for map height H and bands below `order`, with h = pi /
/// H, d = order - 1: in theta, sampling at the centre leaves per row h^3 / 12 (max|p'| max|g'| + max|p''|
/// max|g| / 2) with g = p sin(theta) (Taylor about the centre), and Bernstein's inequality bounds each
/// derivative of these trigonometric polynomials by a factor of degree d, d + 1; sums give h^2 / 12 (d (d +
/// 1) + d^2 / 2) times the largest y^2 = (2 d + 1) / 4 pi times the area 2 pi^2 of the (theta, phi)
/// rectangle. In phi the factor sinc(m h / 2) is known: m^2 h^2 / 24.
double sampling_bound(int order, int height) {
    const double h = kPi / height;
    const double d = order - 1;
    return h * h * (2 * kPi * kPi / 12 * (d * (d + 1) + d * d / 2) * (2 * d + 1) / (4 * kPi) + d * d / 24);
}

std::string message_of_projection(int order, const zonal::EnvironmentMap& map) {
    try {
        zonal::project(order, map);
    } catch (const zonal::Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(runtime_projection, constant_map_has_only_its_mean) {
    // Only rounding: a sum over W = 2 H columns of terms d cos(m phi) errs by at most 2 pi W u, u = 1.1e-16,
    // times the integral of |p_l^m| sin(theta) < 2 sqrt(2 (2 l + 1) / 4 pi) < 5; W = 256: below 1e-12.
    for (const int height : {20, 33, 128}) {
        for (const int order : {1, 6, 20}) {
            const auto f = zonal::project(order, constant_map(height));
            EXPECT_NEAR(f[0].r, std::sqrt(4 * kPi), 1e-12);
            EXPECT_EQ(f[0].r, f[0].b);
            for (std::size_t i = 1; i < f.size(); ++i) {
                EXPECT_NEAR(f[i].r, 0, 1e-12)
                    << "order " << order << ", height " << height << ", index " << i;
            }
        }
    }
}

TEST(runtime_projection, samples_of_a_basis_function_give_back_a_unit_coefficient) {
    const int order = 6;
    const int height = 128;
    const double bound = sampling_bound(order, height);
    ASSERT_LT(bound, 0.05);
    for (std::size_t index = 0; index < 36; ++index) {
        const auto wanted = unit_coefficient(order, index);
        const auto found = zonal::project(order, zonal::reconstruct(order, wanted, height));
        for (std::size_t i = 0; i < wanted.size(); ++i) {
            EXPECT_NEAR(found[i].r, wanted[i].r, bound) << index << " into " << i;
            EXPECT_NEAR(found[i].g, wanted[i].g, 2 * bound) << index << " into " << i;
            EXPECT_NEAR(found[i].b, wanted[i].b, 3 * bound) << index << " into " << i;
        }
    }
}

TEST(runtime_projection, lit_texel_gives_the_exact_integral_of_the_basis_over_it) {
    // One coarse texel with x < 0 < y and z < 0: theta from 90 to 135 degrees, phi from 135 to 180 degrees.
    // Only rounding is left, some epsilons of values below 1.
    const double tolerance = 1e-14;
    zonal::EnvironmentMap map = zonal::black_map(4);
    map.at(3, 2) = {1, 0, -2};
    const auto f = zonal::project(3, map);

    const double theta0 = kPi / 2, theta1 = 3 * kPi / 4, phi0 = 3 * kPi / 4, phi1 = kPi;
    const auto cube = [](double v) { return v * v * v; };
    const double sin1 = std::cos(theta0) - std::cos(theta1);  // integrals over theta of sin, sin^2, ...
    const double sin2 = (theta1 - theta0) / 2 - (std::sin(2 * theta1) - std::sin(2 * theta0)) / 4;
    const double sin3 = sin1 + (cube(std::cos(theta1)) - cube(std::cos(theta0))) / 3;
    const double sin1_cos = (std::pow(std::sin(theta1), 2) - std::pow(std::sin(theta0), 2)) / 2;
    const double sin2_cos = (cube(std::sin(theta1)) - cube(std::sin(theta0))) / 3;
    const double phi_cos = std::sin(phi1) - std::sin(phi0);  // integrals over phi
    const double phi_sin = std::cos(phi0) - std::cos(phi1);
    const double phi_sin_cos = (std::pow(std::sin(phi1), 2) - std::pow(std::sin(phi0), 2)) / 2;
    const double phi_cos_of_2phi = (std::sin(2 * phi1) - std::sin(2 * phi0)) / 2;
    EXPECT_NEAR(f[0].r, std::sqrt(1 / (4 * kPi)) * sin1 * (phi1 - phi0), tolerance);
    EXPECT_NEAR(f[1].r, std::sqrt(3 / (4 * kPi)) * sin2 * phi_sin, tolerance);
    EXPECT_NEAR(f[2].r, std::sqrt(3 / (4 * kPi)) * sin1_cos * (phi1 - phi0), tolerance);
    EXPECT_NEAR(f[3].r, std::sqrt(3 / (4 * kPi)) * sin2 * phi_cos, tolerance);
    EXPECT_NEAR(f[4].r, std::sqrt(15 / (4 * kPi)) * sin3 * phi_sin_cos, tolerance);
    EXPECT_NEAR(f[5].r, std::sqrt(15 / (4 * kPi)) * sin2_cos * phi_sin, tolerance);
    EXPECT_NEAR(f[7].r, std::sqrt(15 / (4 * kPi)) * sin2_cos * phi_cos, tolerance);
    EXPECT_NEAR(f[8].r, std::sqrt(15 / (16 * kPi)) * sin3 * phi_cos_of_2phi, tolerance);
    for (const auto& value : f) {
        EXPECT_EQ(value.g, 0.0);
        EXPECT_EQ(value.b, -2 * value.r);
    }
}

TEST(runtime_projection, basis_is_orthonormal_under_function_projection) {
    // 16 order nodes in theta and 2 order in phi, each value right to some epsilons times order: 1e-12 leaves
    // room.
    for (const int order : {1, 2, 5, 20}) {
        for (std::size_t index = 0; index < static_cast<std::size_t>(order) * order; index += 2 * order - 1) {
            const auto wanted = unit_coefficient(order, index);
            const auto found = zonal::project(
                order, [&](const Eigen::Vector3d& w) { return zonal::evaluate(order, wanted, w); });
            for (std::size_t i = 0; i < wanted.size(); ++i) {
                EXPECT_NEAR(found[i].r, wanted[i].r, 1e-12)
                    << "order " << order << ": " << index << " into " << i;
                EXPECT_NEAR(found[i].b, wanted[i].b, 3e-12)
                    << "order " << order << ": " << index << " into " << i;
            }
        }
    }
}

TEST(runtime_projection, reconstruction_holds_the_function_at_texel_centres) {
    std::vector<Rgb<double>> f(9);
    f[3] = {1, 0, 0};   // x
    f[1] = {0, -2, 0};  // -2 y
    f[2] = {0, 0, 3};   // 3 z
    const zonal::EnvironmentMap map = zonal::reconstruct(3, f, 8);
    ASSERT_EQ(map.width, 16);
    const double scale = std::sqrt(3 / (4 * kPi));
    for (int row = 0; row < map.height; ++row) {
        for (int column = 0; column < map.width; ++column) {
            const Eigen::Vector3d w = zonal::texel_direction(16, 8, column, row);
            EXPECT_FLOAT_EQ(map.at(column, row).r, static_cast<float>(scale * w.x()));
            EXPECT_FLOAT_EQ(map.at(column, row).g, static_cast<float>(-2 * scale * w.y()));
            EXPECT_FLOAT_EQ(map.at(column, row).b, static_cast<float>(3 * scale * w.z()));
        }
    }
}

TEST(runtime_projection, rotated_reconstruction_turns_the_function_not_the_frame) {
    // R = Rz(90 degrees): f = x becomes f' = y.
    const zonal::RotationMatrix<double> quarter_turn(Eigen::AngleAxisd(kPi / 2, Eigen::Vector3d::UnitZ()));
    std::vector<Rgb<double>> x(4);
    x[3] = {1, 1, 1};
    std::vector<Rgb<double>> y(4);
    y[1] = {1, 1, 1};
    const zonal::EnvironmentMap turned = zonal::reconstruct_rotated(2, x, quarter_turn, 8);
    const zonal::EnvironmentMap wanted = zonal::reconstruct(2, y, 8);
    for (std::size_t i = 0; i < wanted.texels.size(); ++i) {
        EXPECT_NEAR(turned.texels[i].r, wanted.texels[i].r,
                    1e-7);  // one rounding to float of values below 1/2
    }
}

TEST(runtime_projection, unusable_arguments_are_refused) {
    EXPECT_NE(message_of_projection(0, constant_map(4)).find("order: found 0"), std::string::npos);
    EXPECT_NE(message_of_projection(5, constant_map(4)).find("for order 5: found 4, wanted at least 5 rows"),
              std::string::npos);
    zonal::EnvironmentMap square = constant_map(4);
    square.width = 4;
    EXPECT_NE(message_of_projection(2, square).find("map: found 4 x 4 with 32 texels"), std::string::npos);
    EXPECT_THROW(zonal::reconstruct(3, std::vector<Rgb<double>>(8), 4), zonal::Error);
    EXPECT_THROW(zonal::reconstruct(3, std::vector<Rgb<double>>(9), 0), zonal::Error);
}

}  // namespace
