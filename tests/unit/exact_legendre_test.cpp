#include <gtest/gtest.h>

#include "exact/legendre.hpp"
#include "exact/spherical_harmonics.hpp"

namespace zonal::exact {
namespace {

const Real kZeroTolerance{"1e-47"};

void expect_zeros(int l, int m, const std::vector<Real>& wanted) {
    const std::vector<Real> found = legendre_zeros(l, m);
    ASSERT_EQ(found.size(), wanted.size()) << "P_" << l << "^" << m;
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_LT(abs(found[i] - wanted[i]), kZeroTolerance) << "P_" << l << "^" << m;
    }
}

TEST(LegendreZeros, known_closed_forms_are_found) {
    expect_zeros(1, 0, {});
    expect_zeros(2, 0, {sqrt(Real(1) / 3)});
    expect_zeros(2, 1, {});
    expect_zeros(3, 0, {sqrt(Real(3) / 5)});
    expect_zeros(3, 1, {sqrt(Real(1) / 5)});
    expect_zeros(4, 0, {sqrt((15 - 2 * sqrt(Real(30))) / 35), sqrt((15 + 2 * sqrt(Real(30))) / 35)});
    expect_zeros(4, 1, {sqrt(Real(3) / 7)});
    expect_zeros(4, 2, {sqrt(Real(1) / 7)});
    expect_zeros(5, 0, {sqrt(5 - 2 * sqrt(Real(10) / 7)) / 3, sqrt(5 + 2 * sqrt(Real(10) / 7)) / 3});
}

TEST(LegendreZeros, every_zero_is_a_zero_of_the_basis_function) {
    for (int l = 1; l < 20; ++l) {
        for (int m = 0; m < l; ++m) {
            const std::vector<Real> zeros = legendre_zeros(l, m);
            ASSERT_EQ(zeros.size(), (l - m) / 2);
            for (const Real& z : zeros) {
                const auto values = evaluate_band<Real>(l, {Real(sqrt(1 - z * z)), Real(0), z});
                EXPECT_LT(abs(values(l + m)), Real{"1e-43"}) << "P_" << l << "^" << m << " at " << z;
            }
        }
    }
}

TEST(MonicLegendreDerivative, times_scale_and_sectoral_factor_is_the_basis) {
    const Real x = Real(2) / 7, y = Real(3) / 7, z = Real(6) / 7;
    for (int l = 0; l < 20; ++l) {
        const auto values = evaluate_band<Real>(l, {x, y, z});
        Real cosine = 1, sine = 0;  // of (x + iy)^m
        for (int m = 0; m <= l; ++m) {
            Real polynomial = 0;
            for (const Real& coefficient : monic_legendre_derivative(l, m)) {
                polynomial = polynomial * z * z + coefficient;
            }
            if ((l - m) % 2 == 1) polynomial *= z;
            const Real common = basis_scale(l, m) * polynomial;
            EXPECT_LT(abs(values(l + m) - common * cosine), Real{"1e-44"}) << "band " << l << ", m " << m;
            if (m > 0) {
                EXPECT_LT(abs(values(l - m) - common * sine), Real{"1e-44"}) << "band " << l << ", m " << -m;
            }
            const Real next = x * cosine - y * sine;
            sine = x * sine + y * cosine;
            cosine = next;
        }
    }
}

}  // namespace
}  // namespace zonal::exact
