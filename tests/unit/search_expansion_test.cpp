#include <gtest/gtest.h>

#include <cmath>

#include "exact/angles.hpp"
#include "exact/spherical_harmonics.hpp"
#include "search/expansion.hpp"
#include "search/random.hpp"

namespace zonal::search {
namespace {

using exact::Matrix;
using exact::Real;

/// |A D Y - I|_F with Y at the angles in 50 digits.
double distance_to_identity(int l, const Expansion& expansion) {
    std::vector<exact::Direction<Real>> lobes;
    for (std::size_t d = 0; d < expansion.angles.size(); d += 2)
        lobes.push_back(exact::direction_of(expansion.angles[d], expansion.angles[d + 1]));
    const int size = 2 * l + 1;
    const Real n = sqrt(4 * exact::pi() / size);
    const Matrix<Real> product = n * expansion.weights.cast<Real>() * exact::band_matrix<Real>(l, lobes);
    return static_cast<double>((product - Matrix<Real>::Identity(size, size)).norm());
}

TEST(Expansion, inverts_the_lobes_to_double_rounding) {
    for (const int l : {1, 2, 3, 5, 7}) {
        for (const std::uint64_t seed : {1, 2}) {
            const Expansion expansion = solve_expansion(l, seed);
            const double rounding = std::sqrt(expansion_rounding(l, expansion.weights));
            EXPECT_LT(std::sqrt(expansion.residual), rounding);
            // What the solver could not see in double is at most as much again.
            EXPECT_LT(distance_to_identity(l, expansion), 2 * rounding) << "band " << l << " seed " << seed;
        }
    }
}

TEST(Expansion, has_one_lobe_at_the_pole_for_the_zonal_function) {
    const int l = 3;
    const Expansion expansion = solve_expansion(l, 1);
    EXPECT_EQ(expansion.angles[2 * l], 0);
    EXPECT_EQ(expansion.angles[2 * l + 1], 0);
    EXPECT_EQ(expansion.weights.row(l), (Matrix<double>::Identity(2 * l + 1, 2 * l + 1).row(l)));
}

TEST(Expansion, depends_on_the_seed_alone) {
    const Expansion first = solve_expansion(4, 7), again = solve_expansion(4, 7),
                    other = solve_expansion(4, 8);
    EXPECT_EQ(first.angles, again.angles);
    EXPECT_EQ(first.weights, again.weights);
    EXPECT_EQ(first.evaluations, again.evaluations);
    EXPECT_NE(first.angles, other.angles);
}

TEST(ExpansionResidual, has_as_many_unknowns_as_the_paper_counts) {
    EXPECT_EQ(ExpansionResidual(2).unknowns(), 28);
    EXPECT_EQ(ExpansionResidual(10).unknowns(), 460);
}

TEST(ExpansionResidual, gradient_agrees_with_differences) {
    for (const int l : {2, 5}) {
        const ExpansionResidual residual(l);
        Random random(3, 0);
        std::vector<double> x(residual.unknowns()), gradient(x.size()), none;
        for (double& unknown : x) unknown = 4 * random.uniform() - 2;
        residual(x, gradient);
        const double step = 1e-6;
        for (std::size_t i = 0; i < x.size(); ++i) {
            std::vector<double> ahead = x, behind = x;
            ahead[i] += step;
            behind[i] -= step;
            const double difference = (residual(ahead, none) - residual(behind, none)) / (2 * step);
            // Central differences lose about epsilon * residual / step.
            EXPECT_NEAR(gradient[i], difference, 1e-9 * residual(x, none))
                << "band " << l << " unknown " << i;
        }
    }
}

}  // namespace
}  // namespace zonal::search
