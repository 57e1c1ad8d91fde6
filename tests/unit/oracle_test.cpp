// The oracle judged by itself: known values, the addition theorem, orthonormality, and that a signal it
// rotated is f(Rᵀω) at points. Tolerances are N² roundings of long double at numbers of size N.
#include "support/oracle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <stdexcept>

namespace zonal::oracle {
namespace {

constexpr Real kPi = std::numbers::pi_v<Real>;
constexpr int kLargest = 20;

Real tolerance(int order) { return order * order * std::numeric_limits<Real>::epsilon() * order; }

Vector3 random_direction(std::mt19937_64& random) {
    std::normal_distribution<Real> normal;
    Vector3 w{normal(random), normal(random), normal(random)};
    const Real length = std::hypot(w[0], w[1], w[2]);
    for (Real& component : w) component /= length;
    return w;
}

Matrix3 about_z(Real angle_rad) {
    return {
        std::cos(angle_rad), -std::sin(angle_rad), 0, std::sin(angle_rad), std::cos(angle_rad), 0, 0, 0, 1};
}

Matrix3 about_x(Real angle_rad) {
    return {
        1, 0, 0, 0, std::cos(angle_rad), -std::sin(angle_rad), 0, std::sin(angle_rad), std::cos(angle_rad)};
}

Matrix3 product(const Matrix3& a, const Matrix3& b) {
    Matrix3 result{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k) result[3 * i + j] += a[3 * i + k] * b[3 * k + j];
    return result;
}

const Matrix3 kRotation = product(about_z(0.7L), product(about_x(1.1L), about_z(-2.3L)));

Vector3 turned_back(const Matrix3& R, const Vector3& w) {
    Vector3 result{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result[i] += R[3 * j + i] * w[j];
    return result;
}

TEST(Oracle, basis_of_low_bands_has_the_values_of_the_literature) {
    std::mt19937_64 random(1);
    for (int k = 0; k < 20; ++k) {
        const auto [x, y, z] = random_direction(random);
        const Real s = 1 / std::sqrt(kPi);
        const Real wanted[] = {s / 2,
                               s * std::sqrt(3.0L) / 2 * y,
                               s * std::sqrt(3.0L) / 2 * z,
                               s * std::sqrt(3.0L) / 2 * x,
                               s * std::sqrt(15.0L) / 2 * x * y,
                               s * std::sqrt(15.0L) / 2 * y * z,
                               s * std::sqrt(5.0L) / 4 * (3 * z * z - 1),
                               s * std::sqrt(15.0L) / 2 * x * z,
                               s * std::sqrt(15.0L) / 4 * (x * x - y * y),
                               s * std::sqrt(17.5L) / 4 * y * (3 * x * x - y * y),
                               s * std::sqrt(105.0L) / 2 * x * y * z,
                               s * std::sqrt(10.5L) / 4 * y * (5 * z * z - 1),
                               s * std::sqrt(7.0L) / 4 * z * (5 * z * z - 3),
                               s * std::sqrt(10.5L) / 4 * x * (5 * z * z - 1),
                               s * std::sqrt(105.0L) / 4 * z * (x * x - y * y),
                               s * std::sqrt(17.5L) / 4 * x * (x * x - 3 * y * y)};
        const std::vector<Real> values = basis(4, {x, y, z});
        for (int i = 0; i < 16; ++i)
            EXPECT_NEAR(static_cast<double>((values[i] - wanted[i]) / tolerance(4)), 0, 1) << i;
    }
}

TEST(Oracle, basis_obeys_the_addition_theorem) {
    std::mt19937_64 random(2);
    for (int k = 0; k < 20; ++k) {
        const Vector3 a = random_direction(random), b = random_direction(random);
        const Real t = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
        const std::vector<Real> at_a = basis(kLargest, a), at_b = basis(kLargest, b);
        for (int l = 0; l < kLargest; ++l) {
            Real sum = 0;
            for (int i = l * l; i < (l + 1) * (l + 1); ++i) sum += at_a[i] * at_b[i];
            const Real wanted = (2 * l + 1) / (4 * kPi) * std::legendre(static_cast<unsigned>(l), t);
            EXPECT_NEAR(static_cast<double>((sum - wanted) / tolerance(kLargest)), 0, 1) << l;
        }
    }
}

TEST(Oracle, evaluate_is_the_sum_of_the_basis) {
    std::mt19937_64 random(3);
    std::normal_distribution<Real> normal;
    for (const int order : {1, 2, 5, kLargest}) {
        std::vector<Real> f(order * order);
        for (Real& coefficient : f) coefficient = normal(random);
        const Vector3 w = random_direction(random);
        const std::vector<Real> values = basis(order, w);
        Real sum = 0;
        for (int i = 0; i < order * order; ++i) sum += f[i] * values[i];
        EXPECT_NEAR(static_cast<double>((evaluate(order, f, w) - sum) / tolerance(order + 1)), 0, 1) << order;
    }
}

TEST(Oracle, identity_returns_an_orthonormal_basis) {
    for (const int order : {1, 2, 3, 6, kLargest}) {
        const auto blocks = Rotation(order).blocks({1, 0, 0, 0, 1, 0, 0, 0, 1});
        for (int l = 0; l < order; ++l)
            for (int i = 0; i < 2 * l + 1; ++i)
                for (int j = 0; j < 2 * l + 1; ++j)
                    EXPECT_NEAR(static_cast<double>((blocks[l][i * (2 * l + 1) + j] - (i == j ? 1 : 0)) /
                                                    tolerance(order)),
                                0, 1)
                        << order << ", band " << l;
    }
}

TEST(Oracle, rotated_signal_is_the_signal_at_directions_rotated_back) {
    std::mt19937_64 random(4);
    std::normal_distribution<Real> normal;
    Matrix3 mirror = kRotation;
    for (Real& entry : mirror) entry = -entry;
    for (const int order : {1, 2, 3, 7, kLargest}) {
        std::vector<Real> f(order * order);
        for (Real& coefficient : f) coefficient = normal(random);
        for (const Matrix3& R : {kRotation, mirror}) {
            const std::vector<Real> rotated = Rotation(order)(R, f);
            for (int k = 0; k < 20; ++k) {
                const Vector3 w = random_direction(random);
                const Real difference = evaluate(order, rotated, w) - evaluate(order, f, turned_back(R, w));
                EXPECT_NEAR(static_cast<double>(difference / tolerance(order)), 0, 1) << order;
            }
        }
    }
}

TEST(Oracle, blocks_times_signal_is_the_rotated_signal) {
    std::mt19937_64 random(5);
    std::normal_distribution<Real> normal;
    for (const int order : {2, 5, 9}) {
        std::vector<Real> f(order * order);
        for (Real& coefficient : f) coefficient = normal(random);
        const Rotation rotation(order);
        const std::vector<Real> rotated = rotation(kRotation, f);
        const auto blocks = rotation.blocks(kRotation);
        for (int l = 0; l < order; ++l) {
            for (int i = 0; i < 2 * l + 1; ++i) {
                Real sum = 0;
                for (int j = 0; j < 2 * l + 1; ++j) sum += blocks[l][i * (2 * l + 1) + j] * f[l * l + j];
                EXPECT_NEAR(static_cast<double>((sum - rotated[l * l + i]) / tolerance(order)), 0, 1);
            }
        }
    }
}

TEST(Oracle, quarter_turn_about_z_takes_x_to_y) {
    std::vector<Real> x(9, 0);
    x[3] = 1;
    const std::vector<Real> y = Rotation(3)({0, -1, 0, 1, 0, 0, 0, 0, 1}, x);
    EXPECT_NEAR(static_cast<double>((y[1] - 1) / tolerance(3)), 0, 1);
    EXPECT_NEAR(static_cast<double>(y[3] / tolerance(3)), 0, 1);
}

TEST(Oracle, nearest_orthonormal_matrix_is_the_factor_beside_a_symmetric_one) {
    // (I + S) Q, S small and symmetric, has the polar factor Q.
    for (const Real size : {1e-1L, 1e-3L, 1e-8L, 0.0L}) {
        const Matrix3 stretched{1 + size,    size / 2,  -size / 3,   size / 2,    1 - size / 5,
                                size * 0.4L, -size / 3, size * 0.4L, 1 + size / 7};
        for (const Real sign : {1, -1}) {
            Matrix3 Q = kRotation;
            for (Real& entry : Q) entry *= sign;
            const Matrix3 found = nearest_orthonormal(product(stretched, Q));
            for (int i = 0; i < 9; ++i)
                EXPECT_NEAR(static_cast<double>((found[i] - Q[i]) / tolerance(2)), 0, 1) << size;
        }
    }
}

TEST(Oracle, orders_that_it_has_no_numbers_for_are_refused) {
    EXPECT_THROW(basis(65, {0, 0, 1}), std::out_of_range);
    EXPECT_THROW(evaluate(65, std::vector<Real>(65 * 65), {0, 0, 1}), std::out_of_range);
}

}  // namespace
}  // namespace zonal::oracle
