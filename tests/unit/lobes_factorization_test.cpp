#include <gtest/gtest.h>

#include <cmath>

#include "exact/angles.hpp"
#include "exact/spherical_harmonics.hpp"
#include "lobes/factorization.hpp"

namespace zonal {
namespace {

using namespace exact;

/// Directions in general position: a spiral.
std::vector<Direction<Real>> spiral(int count) {
    std::vector<Direction<Real>> directions;
    for (int d = 0; d < count; ++d) {
        directions.push_back(direction_of(acos(Real(2 * d + 1) / (2 * count)), Real(12 * d) / 5));
    }
    return directions;
}

TEST(Factorization, times_basis_is_the_identity_at_50_digits) {
    for (int l = 0; l <= 5; ++l) {
        const auto directions = spiral(2 * l + 1);
        const BandFactorization band = factorize_band(l, directions);
        ASSERT_LT(band.condition, 1e3);
        const Matrix<Real> product = band.a_hat * band_matrix<Real>(l, directions);
        const Matrix<Real> error = product - Matrix<Real>::Identity(2 * l + 1, 2 * l + 1);
        EXPECT_LT(error.cwiseAbs().maxCoeff(), Real{"1e-44"}) << "band " << l;
        EXPECT_EQ(band.zeros, 0) << "band " << l;
    }
}

TEST(Factorization, axes_make_band_1_diagonal) {
    const std::vector<Direction<Real>> axes{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};
    const BandFactorization band = factorize_band(1, axes);
    EXPECT_EQ(band.zeros, 6);
    EXPECT_NEAR(band.condition, 1, 1e-14);
    EXPECT_NE(band.a_hat(0, 0), 0);
    EXPECT_EQ(band.a_hat(0, 1), 0);
}

TEST(Factorization, coplanar_lobes_are_singular_in_band_1) {
    const std::vector<Direction<Real>> equator{direction_of(acos(Real(0)), Real(0)),
                                               direction_of(acos(Real(0)), Real(1)),
                                               direction_of(acos(Real(0)), Real(2))};
    EXPECT_TRUE(std::isinf(factorize_band(1, equator).condition));
}

TEST(Factorization, bands_of_an_order_use_the_first_lobes) {
    const auto directions = spiral(7);
    for (int l = 0; l < 4; ++l)
        EXPECT_EQ(factorize_band(l, directions).a_hat,
                  factorize_band(l, {directions.begin(), directions.begin() + 2 * l + 1}).a_hat);
}

}  // namespace
}  // namespace zonal
