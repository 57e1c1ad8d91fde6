#include <gtest/gtest.h>

#include <cmath>

#include "search/closed_form_zeros.hpp"
#include "search/score.hpp"

namespace zonal::search {
namespace {

/// The lobes of band 2 that leave 9 of 25 entries.
struct BestOfBand2 {
    Problem problem = Problem::one_band(2);
    CandidateGrid grid{2};
    LobeSet lobes;

    BestOfBand2() {
        const int third = grid.add_theta(legendre_zero_angles(2, 0).front());
        const auto phi = [&](int eighths) { return grid.add_phi(fraction_of_pi(eighths, 4)); };
        lobes = {grid.canonical(grid.pole(), 0), grid.canonical(third, phi(1)), grid.canonical(third, phi(5)),
                 grid.canonical(third, phi(7)), grid.canonical(grid.equator(), phi(2))};
    }
};

TEST(BandCost, counts_distinct_values_of_each_column_but_the_commonest) {
    // Columns: {2, -2}, {2, 3}, {5, 5}. Factors: 2; 2, 3; 5. The commonest, 2, is the band's own scale.
    const double a_hat[] = {2, -2, 0, 2, 0, 3, 0, 5, 5};
    const BandCost cost = band_cost(a_hat, 3);
    EXPECT_EQ(cost.nonzeros, 6);
    EXPECT_EQ(cost.multiplications, 2);
}

TEST(BandCost, zero_and_equal_are_decided_with_a_margin) {
    const double a_hat[] = {1, 1e-10, 1 + 1e-12, 1.001};
    const BandCost cost = band_cost(a_hat, 2);
    EXPECT_EQ(cost.nonzeros, 3);
    EXPECT_EQ(cost.multiplications, 1);
}

TEST(Score, knows_the_best_set_of_band_2) {
    const BestOfBand2 best;
    const Score score = search::score(best.problem, best.grid, best.lobes);
    EXPECT_EQ(score.zeros, 16);
    EXPECT_EQ(score.nonzeros, 9);
    EXPECT_NEAR(score.condition, 2.12, 0.01);
}

TEST(Score, in_double_agrees_with_50_digits) {
    const BestOfBand2 best;
    std::vector<exact::Direction<exact::Real>> directions;
    for (const Lobe lobe : best.lobes) directions.push_back(best.grid.direction(lobe));
    const Score fast = score(best.problem, best.grid, best.lobes);
    const Score exact = exact_score(best.problem, directions);
    EXPECT_EQ(fast.zeros, exact.zeros);
    EXPECT_EQ(fast.multiplications, exact.multiplications);
    EXPECT_NEAR(fast.condition, exact.condition, 1e-12);
    EXPECT_NEAR(fast.norm, exact.norm, 1e-12);
}

TEST(Score, singular_is_worse_than_over_the_cap_is_worse_than_allowed) {
    const BestOfBand2 best;
    LobeSet twice = best.lobes;
    twice[4] = twice[1];
    const Score good = score(best.problem, best.grid, best.lobes);
    const Score singular = score(best.problem, best.grid, twice);
    Objective strict;
    strict.condition_cap = 2;
    EXPECT_TRUE(singular.is_singular());
    EXPECT_TRUE(std::isinf(singular.cost({})));
    EXPECT_FALSE(good.is_allowed(strict));
    EXPECT_GT(singular.cost(strict), good.cost(strict));
    EXPECT_GT(good.cost(strict), good.cost({}) + 1000);
}

TEST(Score, singular_in_a_lower_band_counts_too) {
    // Three lobes in the plane x = 0: band 1 is singular, whatever band 2 says.
    CandidateGrid grid(2);
    const int third = grid.add_theta(legendre_zero_angles(2, 0).front());
    const auto phi = [&](int eighths) { return grid.add_phi(fraction_of_pi(eighths, 4)); };
    const LobeSet lobes{grid.canonical(grid.pole(), 0), grid.canonical(third, phi(2)),
                        grid.canonical(grid.equator(), phi(2)), grid.canonical(third, phi(1)),
                        grid.canonical(third, phi(7))};
    EXPECT_TRUE(score(Problem::shared(3), grid, lobes).is_singular());
}

TEST(TurningCost, axes_are_free) {
    using exact::Direction;
    using exact::Real;
    EXPECT_EQ(turning_cost({Direction<Real>{0, 0, 1}, Direction<Real>{-1, 0, 0}}), 0);
    EXPECT_EQ(turning_cost({Direction<Real>{Real(3) / 5, 0, Real(4) / 5}}), 2);
}

}  // namespace
}  // namespace zonal::search
