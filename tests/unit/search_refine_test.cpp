#include <gtest/gtest.h>

#include "exact/spherical_harmonics.hpp"
#include "search/angle_model.hpp"
#include "search/closed_form_zeros.hpp"
#include "search/genetic.hpp"
#include "search/pattern.hpp"
#include "search/polish.hpp"
#include "search/refine.hpp"
#include "support/lobe_sets.hpp"

namespace zonal::search {
namespace {

using exact::Real;

bool never() { return false; }

/// Angles in general position.
std::vector<double> scattered_angles(int lobes) {
    std::vector<double> angles;
    for (int d = 0; d < lobes; ++d) {
        angles.push_back(0.3 + 1.1 * d / lobes);
        angles.push_back(2.4 * d);
    }
    return angles;
}

TEST(DifferentiateBand, agrees_with_the_basis_and_its_differences) {
    const double theta = 0.7, phi = 0.4, step = 1e-6;
    for (int l = 0; l <= 8; ++l) {
        const BandDerivatives band = differentiate_band(l, theta, phi);
        const auto at = [&](double t, double p) {
            return exact::evaluate_band<double>(
                l, {std::sin(t) * std::cos(p), std::sin(t) * std::sin(p), std::cos(t)});
        };
        EXPECT_LT((band.values - at(theta, phi)).norm(), 1e-13);
        const exact::Vector<double> by_theta = (at(theta + step, phi) - at(theta - step, phi)) / (2 * step);
        const exact::Vector<double> by_phi = (at(theta, phi + step) - at(theta, phi - step)) / (2 * step);
        EXPECT_LT((band.by_theta - by_theta).norm(), 1e-7) << "band " << l;
        EXPECT_LT((band.by_phi - by_phi).norm(), 1e-7) << "band " << l;
    }
}

TEST(AngleModel, gradients_agree_with_differences) {
    const Problem problem = Problem::shared(4);
    const std::vector<double> angles = scattered_angles(7);
    const Relation zero{2, 3, 5}, equality{1, 0, 2, 4, -1};
    AngleModel model(problem);
    ASSERT_TRUE(model.evaluate(angles));
    const auto zero_gradient = model.residual_gradient(zero);
    const auto equality_gradient = model.residual_gradient(equality);
    const exact::Matrix<double> jacobian = model.jacobian({zero, equality});
    EXPECT_LT((jacobian.row(0).transpose() - zero_gradient).norm(), 1e-12 * zero_gradient.norm());
    EXPECT_LT((jacobian.row(1).transpose() - equality_gradient).norm(), 1e-12 * equality_gradient.norm());
    exact::Vector<double> norm_gradient = exact::Vector<double>::Zero(14);
    model.log_norm(1, norm_gradient.data());

    const double step = 1e-6;
    for (int i = 0; i < 14; ++i) {
        double zero_at[2], equality_at[2], norm_at[2];
        for (int side = 0; side < 2; ++side) {
            std::vector<double> moved = angles;
            moved[i] += side == 0 ? -step : step;
            ASSERT_TRUE(model.evaluate(moved));
            zero_at[side] = model.residual(zero);
            equality_at[side] = model.residual(equality);
            exact::Vector<double> ignored = exact::Vector<double>::Zero(14);
            norm_at[side] = model.log_norm(1, ignored.data());
        }
        EXPECT_NEAR(zero_gradient(i), (zero_at[1] - zero_at[0]) / (2 * step), 1e-6);
        EXPECT_NEAR(equality_gradient(i), (equality_at[1] - equality_at[0]) / (2 * step), 1e-6);
        EXPECT_NEAR(norm_gradient(i), (norm_at[1] - norm_at[0]) / (2 * step), 1e-6);
    }
}

TEST(Polish, takes_a_perturbed_pattern_to_1e_minus_45) {
    const Problem problem = Problem::one_band(4);
    const AngledSet exact_set = best_of_band_4();
    ASSERT_EQ(confirm(problem, exact_set).score.zeros, 52);
    std::vector<double> angles;
    for (const AngledLobe& lobe : exact_set) {
        angles.push_back(static_cast<double>(lobe.theta.value));
        angles.push_back(static_cast<double>(lobe.phi.value));
    }
    AngleModel model(problem);
    ASSERT_TRUE(model.evaluate(angles));
    const Pattern pattern = zeros_of(model.a_hats());
    ASSERT_EQ(pattern.size(), 52);

    AngledSet perturbed = exact_set;
    perturbed[7].theta.value += Real{"1e-5"};
    perturbed[8].theta.value -= Real{"2e-5"};
    ASSERT_LT(confirm(problem, perturbed).score.zeros, 52);
    std::vector<bool> is_free(18, false);
    is_free[14] = is_free[16] = true;
    const auto polished = polish(problem, perturbed, pattern, is_free);
    ASSERT_TRUE(polished.has_value());
    EXPECT_LT(largest_residual(problem, *polished, pattern), Real{"1e-45"});
    EXPECT_EQ(confirm(problem, *polished).score.zeros, 52);
    EXPECT_EQ((*polished)[5].theta.text, "acos(sqrt(3/7))");
}

TEST(Polish, gives_up_on_a_pattern_that_cannot_hold) {
    const Problem problem = Problem::one_band(2);
    AngledSet lobes;
    for (int d = 0; d < 5; ++d) lobes.push_back({{Real(3 + d) / 8, ""}, {Real(12 * d) / 5, ""}});
    Pattern whole_column;
    for (int row = 0; row < 5; ++row) whole_column.push_back({0, row, 0});
    EXPECT_FALSE(polish(problem, lobes, whole_column, std::vector<bool>(10, true)).has_value());
}

TEST(Refine, gains_zeros_of_band_4_off_the_grid) {
    const Problem problem = Problem::one_band(4);
    CandidateGrid grid(4);
    const Pool pool(grid, {4, 6});
    Population population(problem, grid, pool, {}, Genetic::with_local_steps(problem), Random(1, 0));
    for (int generation = 0; generation < 3; ++generation) population.evolve();
    const Solution start = confirm(problem, with_angles(grid, population.best().lobes));
    const Solution refined = refine(problem, {}, start, never);
    EXPECT_LE(start.score.zeros, 50);
    EXPECT_EQ(refined.score.zeros, 52);
    EXPECT_LT(refined.score.cost({}), start.score.cost({}));
    // Angles that stayed keep their closed form, those that moved are decimals that say where they are.
    int closed_forms = 0;
    for (const AngledLobe& lobe : refined.lobes) {
        closed_forms += lobe.theta.text.size() < 40;
        EXPECT_LT(abs(exact::evaluate_closed_form(lobe.theta.text) - lobe.theta.value), Real{"1e-47"});
        EXPECT_LT(abs(exact::evaluate_closed_form(lobe.phi.text) - lobe.phi.value), Real{"1e-47"});
    }
    EXPECT_GE(closed_forms, 1);
}

TEST(Refine, leaves_alone_what_has_no_freedom) {
    const Problem problem = Problem::one_band(2);
    CandidateGrid grid(2);
    const Pool pool(grid, {4, 6});
    Population population(problem, grid, pool, {}, Genetic::with_local_steps(problem), Random(1, 0));
    population.evolve();
    const Solution start = confirm(problem, with_angles(grid, population.best().lobes));
    ASSERT_EQ(start.score.zeros, 16);
    EXPECT_EQ(refine(problem, {}, start, never).score.zeros, 16);
}

}  // namespace
}  // namespace zonal::search
