#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "exact/spherical_harmonics.hpp"
#include "lobes/ring.hpp"

namespace zonal {
namespace {

using namespace exact;

TEST(Ring, factorization_undoes_the_sampling_of_a_band) {
    const Ring ring = best_ring(7);
    ASSERT_EQ(ring.count, 13);
    const std::vector<Direction<Real>> lobes = ring.directions();
    for (int l = 0; l < 7; ++l) {
        const int size = 2 * l + 1;
        Matrix<Real> y(ring.count, size);
        for (int d = 0; d < ring.count; ++d) y.row(d) = evaluate_band<Real>(l, lobes[d]).transpose();
        const BandFactorization band = ring.factorize(l);
        const Matrix<Real> product = band.a_hat * y;
        const Matrix<Real> error = product - Matrix<Real>::Identity(size, size);
        EXPECT_LT(error.cwiseAbs().maxCoeff(), Real("1e-45")) << "band " << l;
    }
}

TEST(Ring, condition_is_that_of_the_sampled_band) {
    const Ring ring = best_ring(5);
    for (int l = 1; l < 5; ++l) {
        Matrix<double> y(ring.count, 2 * l + 1);
        const std::vector<Direction<Real>> lobes = ring.directions();
        for (int d = 0; d < ring.count; ++d)
            y.row(d) = evaluate_band<Real>(l, lobes[d]).cast<double>().transpose();
        const Eigen::JacobiSVD<Matrix<double>> svd(y);
        const double condition = svd.singularValues()(0) / svd.singularValues()(2 * l);
        EXPECT_NEAR(ring.factorize(l).condition, condition, 1e-12 * condition);
    }
}

/// What the ring is for.
TEST(Ring, condition_is_at_most_10_in_every_band_of_every_order) {
    for (int order = 3; order <= 20; ++order) {
        const Ring ring = best_ring(order);
        for (int l = 0; l < order; ++l)
            EXPECT_LE(ring.factorize(l).condition, 10) << "order " << order << " band " << l;
    }
}

}  // namespace
}  // namespace zonal
