#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "zonal/basis.hpp"
#include "zonal/eigen.hpp"
#include "zonal/error.hpp"

namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMaxOrder = 20;

std::vector<double> basis_at(int order, const Eigen::Vector3d& direction) {
    std::vector<double> values(static_cast<std::size_t>(order) * order);
    zonal::evaluate_basis(order, direction, values);
    return values;
}

/// In general position, in several octants, and close to both poles.
std::vector<Eigen::Vector3d> directions() {
    std::vector<Eigen::Vector3d> result;
    for (const auto& [x, y, z] : {std::array{0.3, 0.5, 0.7},
                                  {-0.9, 0.2, -0.1},
                                  {0.2, -0.8, 0.4},
                                  {-1e-3, 2e-3, 1.0},
                                  {1e-9, -2e-9, -1.0},
                                  {1.0, 0.0, 0.0},
                                  {0.0, 1.0, 0.0}}) {
        result.push_back(Eigen::Vector3d(x, y, z).normalized());
    }
    return result;
}

/// A value of band l is a sum of at most l + 1 terms bounded by sqrt((2 l + 1) / 4 pi) < 2, reached by 2 l
/// recurrence steps of 3 roundings: 1e-14 leaves a factor above 3 for l <= 4.
constexpr double kClosedFormTolerance = 1e-14;

TEST(runtime_basis, bands_0_to_2_match_closed_forms) {
    for (const Eigen::Vector3d& w : directions()) {
        const double x = w.x(), y = w.y(), z = w.z();
        const std::vector<double> f = basis_at(3, w);
        EXPECT_NEAR(f[0], std::sqrt(1 / (4 * kPi)), kClosedFormTolerance);
        EXPECT_NEAR(f[1], std::sqrt(3 / (4 * kPi)) * y, kClosedFormTolerance);
        EXPECT_NEAR(f[2], std::sqrt(3 / (4 * kPi)) * z, kClosedFormTolerance);
        EXPECT_NEAR(f[3], std::sqrt(3 / (4 * kPi)) * x, kClosedFormTolerance);
        EXPECT_NEAR(f[4], std::sqrt(15 / (4 * kPi)) * x * y, kClosedFormTolerance);
        EXPECT_NEAR(f[5], std::sqrt(15 / (4 * kPi)) * y * z, kClosedFormTolerance);
        EXPECT_NEAR(f[6], std::sqrt(5 / (16 * kPi)) * (3 * z * z - 1), kClosedFormTolerance);
        EXPECT_NEAR(f[7], std::sqrt(15 / (4 * kPi)) * x * z, kClosedFormTolerance);
        EXPECT_NEAR(f[8], std::sqrt(15 / (16 * kPi)) * (x * x - y * y), kClosedFormTolerance);
    }
}

TEST(runtime_basis, bands_3_and_4_match_closed_forms) {
    for (const Eigen::Vector3d& w : directions()) {
        const double x = w.x(), y = w.y(), z = w.z();
        const std::vector<double> f = basis_at(5, w);
        EXPECT_NEAR(f[9], std::sqrt(35 / (32 * kPi)) * y * (3 * x * x - y * y), kClosedFormTolerance);
        EXPECT_NEAR(f[10], std::sqrt(105 / (4 * kPi)) * x * y * z, kClosedFormTolerance);
        EXPECT_NEAR(f[11], std::sqrt(21 / (32 * kPi)) * y * (5 * z * z - 1), kClosedFormTolerance);
        EXPECT_NEAR(f[12], std::sqrt(7 / (16 * kPi)) * z * (5 * z * z - 3), kClosedFormTolerance);
        EXPECT_NEAR(f[15], std::sqrt(35 / (32 * kPi)) * x * (x * x - 3 * y * y), kClosedFormTolerance);
        EXPECT_NEAR(f[16], 0.75 * std::sqrt(35 / kPi) * x * y * (x * x - y * y), kClosedFormTolerance);
        EXPECT_NEAR(f[17], 0.75 * std::sqrt(35 / (2 * kPi)) * y * z * (3 * x * x - y * y),
                    kClosedFormTolerance);
        EXPECT_NEAR(f[20], std::sqrt(9 / (256 * kPi)) * (35 * z * z * z * z - 30 * z * z + 3),
                    kClosedFormTolerance);
        EXPECT_NEAR(f[21], 0.75 * std::sqrt(5 / (2 * kPi)) * x * z * (7 * z * z - 3), kClosedFormTolerance);
        EXPECT_NEAR(f[22], 0.375 * std::sqrt(5 / kPi) * (x * x - y * y) * (7 * z * z - 1),
                    kClosedFormTolerance);
    }
}

TEST(runtime_basis, all_bands_match_the_standard_library) {
    // std::sph_legendre has the Condon-Shortley sign and lacks the sqrt(2); its error is that of a product of
    // order-20 factors of theta and of the logarithm of a factorial, up to 40 ln 40 epsilon: 1e-12 is ample.
    const double theta_rad = 1.1;
    const double phi_rad = 0.4;
    const Eigen::Vector3d w(std::sin(theta_rad) * std::cos(phi_rad), std::sin(theta_rad) * std::sin(phi_rad),
                            std::cos(theta_rad));
    const std::vector<double> f = basis_at(kMaxOrder, w);
    for (int l = 0; l < kMaxOrder; ++l) {
        EXPECT_NEAR(f[l * (l + 1)], std::sph_legendre(l, 0, theta_rad), 1e-12) << "l = " << l;
        for (int m = 1; m <= l; ++m) {
            const double sign = m % 2 == 0 ? 1 : -1;
            const double p = std::numbers::sqrt2 * sign * std::sph_legendre(l, m, theta_rad);
            EXPECT_NEAR(f[l * (l + 1) + m], p * std::cos(m * phi_rad), 1e-12) << "l = " << l << ", m = " << m;
            EXPECT_NEAR(f[l * (l + 1) - m], p * std::sin(m * phi_rad), 1e-12)
                << "l = " << l << ", m = " << -m;
        }
    }
}

TEST(runtime_basis, squares_of_a_band_add_to_a_constant) {
    // Addition theorem: sum over m of y_l^m(w)^2 = (2 l + 1) / 4 pi. A direction normalised in double has
    // |w|^2 = 1 + 2 epsilon at worst, which the sum takes to the power l; the recurrence adds some epsilons a
    // step.
    for (const Eigen::Vector3d& w : directions()) {
        const std::vector<double> f = basis_at(kMaxOrder, w);
        for (int l = 0; l < kMaxOrder; ++l) {
            double sum = 0;
            for (int i = l * l; i < (l + 1) * (l + 1); ++i) sum += f[i] * f[i];
            const double wanted = (2 * l + 1) / (4 * kPi);
            const double relative = 16 * (l + 1) * std::numeric_limits<double>::epsilon();
            EXPECT_NEAR(sum, wanted, relative * wanted) << "l = " << l << ", w = " << w.transpose();
        }
    }
}

TEST(runtime_basis, poles_hold_only_zonal_values) {
    for (const double z : {1.0, -1.0}) {
        const std::vector<double> f = basis_at(kMaxOrder, {0, 0, z});
        for (int l = 0; l < kMaxOrder; ++l) {
            const double wanted = std::sqrt((2 * l + 1) / (4 * kPi)) * (l % 2 == 0 ? 1 : z);
            EXPECT_NEAR(f[l * (l + 1)], wanted, 16 * (l + 1) * std::numeric_limits<double>::epsilon());
            for (int m = 1; m <= l; ++m) {
                EXPECT_EQ(f[l * (l + 1) + m], 0.0);
                EXPECT_EQ(f[l * (l + 1) - m], 0.0);
            }
        }
    }
}

TEST(runtime_basis, lower_order_is_a_prefix_of_a_higher_one) {
    const Eigen::Vector3d w = directions().front();
    const std::vector<double> all = basis_at(kMaxOrder, w);
    for (int order = 1; order < kMaxOrder; ++order) {
        const std::vector<double> f = basis_at(order, w);
        EXPECT_TRUE(std::equal(f.begin(), f.end(), all.begin())) << "order " << order;
    }
}

TEST(runtime_basis, evaluation_weighs_each_channel_with_its_own_coefficients) {
    // 1 + 2 y - 3 z + 5 x in red, its negative in green, 7 x y in blue.
    const double s0 = std::sqrt(4 * kPi), s1 = std::sqrt(4 * kPi / 3), s2 = std::sqrt(4 * kPi / 15);
    std::vector<zonal::Rgb<double>> f(9);
    f[0] = {s0, -s0, 0};
    f[1] = {2 * s1, -2 * s1, 0};
    f[2] = {-3 * s1, 3 * s1, 0};
    f[3] = {5 * s1, -5 * s1, 0};
    f[4] = {0, 0, 7 * s2};
    std::vector<double> red;
    for (const auto& value : f) red.push_back(value.r);
    for (const Eigen::Vector3d& w : directions()) {
        const double wanted = 1 + 2 * w.y() - 3 * w.z() + 5 * w.x();
        const zonal::Rgb<double> found = zonal::evaluate(3, f, w);
        EXPECT_NEAR(found.r, wanted, 10 * kClosedFormTolerance);
        EXPECT_NEAR(found.g, -wanted, 10 * kClosedFormTolerance);
        EXPECT_NEAR(found.b, 7 * w.x() * w.y(), 10 * kClosedFormTolerance);
        EXPECT_EQ(zonal::evaluate(3, red, w), found.r);
    }
}

std::string message_of_basis(int order, std::size_t length) {
    std::vector<double> values(length);
    try {
        zonal::evaluate_basis(order, {0, 0, 1}, values);
    } catch (const zonal::Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(runtime_basis, order_out_of_range_is_refused) {
    EXPECT_NE(message_of_basis(0, 0).find("order: found 0, wanted 1 to 20"), std::string::npos);
    EXPECT_NE(message_of_basis(21, 441).find("order: found 21, wanted 1 to 20"), std::string::npos);
}

TEST(runtime_basis, wrong_length_is_refused) {
    const std::string message = message_of_basis(4, 15);
    EXPECT_NE(message.find("values for order 4: found 15, wanted 16"), std::string::npos) << message;
}

}  // namespace
