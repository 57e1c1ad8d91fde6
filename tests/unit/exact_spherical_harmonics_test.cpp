#include <gtest/gtest.h>

#include "exact/spherical_harmonics.hpp"

namespace zonal::exact {
namespace {

const Real kHarmonicTolerance{"1e-47"};

/// The unit direction (2, 3, 6)/7: rational, and no two components alike.
Direction<Real> asymmetric() { return {Real(2) / 7, Real(3) / 7, Real(6) / 7}; }

Direction<Real> another() { return {Real(6) / 11, Real(-7) / 11, Real(6) / 11}; }

TEST(SphericalHarmonics, band_1_is_y_z_x) {
    const Real k = sqrt(3 / (4 * pi()));
    const auto values = evaluate_band<Real>(1, asymmetric());
    EXPECT_LT(abs(values(0) - k * 3 / 7), kHarmonicTolerance);
    EXPECT_LT(abs(values(1) - k * 6 / 7), kHarmonicTolerance);
    EXPECT_LT(abs(values(2) - k * 2 / 7), kHarmonicTolerance);
}

TEST(SphericalHarmonics, band_2_is_the_tabulated_quadratics) {
    const Real x = Real(2) / 7, y = Real(3) / 7, z = Real(6) / 7;
    const Real k = sqrt(15 / (4 * pi()));
    const auto values = evaluate_band<Real>(2, asymmetric());
    EXPECT_LT(abs(values(0) - k * x * y), kHarmonicTolerance);
    EXPECT_LT(abs(values(1) - k * y * z), kHarmonicTolerance);
    EXPECT_LT(abs(values(2) - sqrt(5 / (16 * pi())) * (3 * z * z - 1)), kHarmonicTolerance);
    EXPECT_LT(abs(values(3) - k * x * z), kHarmonicTolerance);
    EXPECT_LT(abs(values(4) - k / 2 * (x * x - y * y)), kHarmonicTolerance);
}

TEST(SphericalHarmonics, band_3_is_the_tabulated_cubics) {
    const Real x = Real(2) / 7, y = Real(3) / 7, z = Real(6) / 7;
    const auto values = evaluate_band<Real>(3, asymmetric());
    EXPECT_LT(abs(values(0) - sqrt(35 / (32 * pi())) * y * (3 * x * x - y * y)), kHarmonicTolerance);
    EXPECT_LT(abs(values(1) - sqrt(105 / (4 * pi())) * x * y * z), kHarmonicTolerance);
    EXPECT_LT(abs(values(2) - sqrt(21 / (32 * pi())) * y * (5 * z * z - 1)), kHarmonicTolerance);
    EXPECT_LT(abs(values(3) - sqrt(7 / (16 * pi())) * z * (5 * z * z - 3)), kHarmonicTolerance);
    EXPECT_LT(abs(values(4) - sqrt(21 / (32 * pi())) * x * (5 * z * z - 1)), kHarmonicTolerance);
    EXPECT_LT(abs(values(5) - sqrt(105 / (16 * pi())) * z * (x * x - y * y)), kHarmonicTolerance);
    EXPECT_LT(abs(values(6) - sqrt(35 / (32 * pi())) * x * (x * x - 3 * y * y)), kHarmonicTolerance);
}

TEST(SphericalHarmonics, addition_theorem_holds_at_50_digits) {
    const Real cosine = asymmetric().dot(another());
    Real before = 0, legendre = 1;  // P_{l-1} and P_l at the cosine
    for (int l = 0; l < 20; ++l) {
        const Real sum = evaluate_band<Real>(l, asymmetric()).dot(evaluate_band<Real>(l, another()));
        EXPECT_LT(abs(sum - (2 * l + 1) / (4 * pi()) * legendre), kHarmonicTolerance * (2 * l + 1))
            << "band " << l;
        const Real after = ((2 * l + 1) * cosine * legendre - l * before) / (l + 1);
        before = legendre;
        legendre = after;
    }
}

TEST(SphericalHarmonics, pole_has_only_the_zonal_value) {
    for (int l = 0; l < 20; ++l) {
        const auto values = evaluate_band<Real>(l, {Real(0), Real(0), Real(1)});
        for (int m = -l; m <= l; ++m) {
            const Real wanted = m == 0 ? Real(sqrt((2 * l + 1) / (4 * pi()))) : Real(0);
            EXPECT_LT(abs(values(l + m) - wanted), kHarmonicTolerance) << "band " << l << ", m " << m;
        }
    }
}

TEST(SphericalHarmonics, double_agrees_with_50_digits) {
    for (int l = 0; l < 20; ++l) {
        const Vector<double> rounded = evaluate_band<double>(l, asymmetric().cast<double>());
        const Vector<double> exact = evaluate_band<Real>(l, asymmetric()).cast<double>();
        EXPECT_LT((rounded - exact).cwiseAbs().maxCoeff(), 1e-15 * (l + 1)) << "band " << l;
    }
}

}  // namespace
}  // namespace zonal::exact
