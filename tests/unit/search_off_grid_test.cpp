#include <gtest/gtest.h>

#include <cmath>

#include "search/angle_walk.hpp"
#include "search/off_grid_search.hpp"
#include "search/polish.hpp"
#include "support/lobe_sets.hpp"
#include "support/no_stop.hpp"

namespace zonal::search {
namespace {

constexpr int kMoves = 300;

SearchSettings settings_for(int generations) {
    SearchSettings settings;
    settings.generations = generations;
    settings.islands = 2;
    settings.start = band_4_on_the_grid();
    return settings;
}

TEST(AngleWalk, finds_zeros_and_costs_that_50_digits_confirm) {
    const Problem problem = Problem::one_band(4);
    AngleWalk walk(problem, {}, 1.0, Random(1, 0));
    walk.start_from(band_4_on_the_grid());
    EXPECT_NEAR(walk.best().cost, confirm(problem, band_4_on_the_grid()).score.cost({}), 1e-6);
    const double cost_of_start = walk.best().cost;
    for (int move = 0; move < kMoves; ++move) walk.move();
    EXPECT_LT(walk.best().cost, cost_of_start - 1);
    const auto polished = polish_moved(problem, band_4_on_the_grid(), walk.best().angles, walk.best().zeros);
    ASSERT_TRUE(polished.has_value());
    const Score score = confirm(problem, *polished).score;
    EXPECT_EQ(score.zeros, static_cast<int>(walk.best().zeros.size()));
    EXPECT_NEAR(score.cost({}), walk.best().cost, 1e-6);
    EXPECT_GT(walk.evaluations(), kMoves);
}

TEST(AngleWalk, comes_back_to_its_start) {
    const Problem problem = Problem::one_band(4);
    AngleWalk walk(problem, {}, 1.0, Random(1, 0));
    walk.start_from(band_4_on_the_grid());
    const AngleWalk::Place start = walk.best();
    for (int move = 0; move < kMoves; ++move) walk.move();
    ASSERT_NE(walk.best().angles, start.angles);
    walk.start_from(band_4_on_the_grid());
    EXPECT_EQ(walk.best().angles, start.angles);
    EXPECT_EQ(walk.best().cost, start.cost);
}

TEST(OffGridSearch, gains_zeros_of_band_4_that_50_digits_confirm) {
    const Problem problem = Problem::one_band(4);
    const Score start = confirm(problem, band_4_on_the_grid()).score;
    const SearchResult result = search_off_grid(problem, settings_for(2), kMoves, kNoStop);
    EXPECT_LT(start.zeros, 52);
    EXPECT_EQ(result.best.score.zeros, 52);
    EXPECT_EQ(confirm(problem, result.best.lobes).score.zeros, 52);
    EXPECT_LT(result.best.score.cost({}), start.cost({}));
    int closed_forms = 0;
    for (const AngledLobe& lobe : result.best.lobes) {
        closed_forms += lobe.theta.text.size() < 40;
        EXPECT_LT(abs(exact::evaluate_closed_form(lobe.theta.text) - lobe.theta.value), exact::Real{"1e-47"});
        EXPECT_LT(abs(exact::evaluate_closed_form(lobe.phi.text) - lobe.phi.value), exact::Real{"1e-47"});
        EXPECT_GE(lobe.theta.value, 0);
        EXPECT_LT(lobe.theta.value, exact::Real{"1.5707963267948966193"});
    }
    EXPECT_GE(closed_forms, 2);
}

TEST(OffGridSearch, same_seed_and_generations_give_the_same_lobes) {
    const Problem problem = Problem::one_band(4);
    SearchSettings settings = settings_for(3);
    settings.generations_between_exchanges = 2;
    const SearchResult first = search_off_grid(problem, settings, kMoves, kNoStop);
    const SearchResult second = search_off_grid(problem, settings, kMoves, kNoStop);
    EXPECT_EQ(texts_of(first.best.lobes), texts_of(second.best.lobes));
    EXPECT_EQ(first.progress.evaluations, second.progress.evaluations);
    settings.seed = 2;
    EXPECT_NE(search_off_grid(problem, settings, kMoves, kNoStop).progress.evaluations,
              first.progress.evaluations);
}

TEST(OffGridSearch, keeps_the_condition_under_the_cap) {
    const Problem problem = Problem::one_band(4);
    SearchSettings settings = settings_for(2);
    settings.objective.condition_weight = 0;
    const double condition_without = search_off_grid(problem, settings, kMoves, kNoStop).best.score.condition;
    settings.objective.condition_cap = condition_without - 0.1;
    const SearchResult result = search_off_grid(problem, settings, kMoves, kNoStop);
    EXPECT_LE(result.best.score.condition, settings.objective.condition_cap);
    ASSERT_FALSE(result.front.empty());
    for (const Solution& solution : result.front)
        EXPECT_LE(solution.score.condition, settings.objective.condition_cap);
}

TEST(OffGridSearch, front_begins_with_the_start) {
    const Problem problem = Problem::one_band(4);
    const std::atomic<bool> stop = true;
    const SearchResult result = search_off_grid(problem, settings_for(1), kMoves, stop);
    ASSERT_EQ(result.front.size(), 1);
    EXPECT_EQ(texts_of(result.front[0].lobes), texts_of(band_4_on_the_grid()));
}

TEST(OffGridSearch, told_to_stop_returns_its_start) {
    const Problem problem = Problem::one_band(4);
    const std::atomic<bool> stop = true;
    const SearchResult result = search_off_grid(problem, settings_for(1000), kMoves, stop);
    EXPECT_EQ(result.progress.generation, 1);
    EXPECT_EQ(texts_of(result.best.lobes), texts_of(band_4_on_the_grid()));
}

TEST(OffGridSearch, finds_zeros_for_shared_lobes_that_had_hardly_any) {
    const Problem problem = Problem::shared(3);
    SearchSettings settings = settings_for(2);
    settings.start = AngledSet{lobe("0", "0"), lobe("pi/2", "0"), lobe("pi/2", "pi/3"), lobe("pi/3", "pi/5"),
                               lobe("pi/3", "9*pi/7")};
    const Solution start = confirm(problem, *settings.start);
    const SearchResult result = search_off_grid(problem, settings, kMoves, kNoStop);
    EXPECT_GE(start.score.nonzeros, 16);
    EXPECT_LE(result.best.score.nonzeros, 10);
    EXPECT_LE(result.best.score.condition, 50);
}

TEST(PolishMoved, puts_a_lobe_on_the_pole_and_keeps_the_text_of_the_others) {
    const Problem problem = Problem::one_band(4);
    AngledSet away = band_4_on_the_grid();
    away[0] = lobe("1/10", "0");
    std::vector<double> angles = angles_in_double(band_4_on_the_grid());
    AngleModel model(problem);
    ASSERT_TRUE(model.evaluate(angles));
    const auto polished = polish_moved(problem, away, angles, zeros_of(model.a_hats()));
    ASSERT_TRUE(polished.has_value());
    EXPECT_EQ(texts_of(*polished), texts_of(band_4_on_the_grid()));
}

TEST(PolishMoved, brings_angles_into_their_ranges) {
    const Problem problem = Problem::one_band(4);
    std::vector<double> angles = angles_in_double(band_4_on_the_grid());
    AngleModel model(problem);
    ASSERT_TRUE(model.evaluate(angles));
    const Pattern zeros = zeros_of(model.a_hats());
    angles[10] = -angles[10];  // across the pole
    angles[12] = M_PI - angles[12];
    angles[13] += M_PI;      // the antipode
    angles[15] -= 4 * M_PI;  // two turns back
    const auto polished = polish_moved(problem, band_4_on_the_grid(), angles, zeros);
    ASSERT_TRUE(polished.has_value());
    AngledSet expected = band_4_on_the_grid();
    expected[5].phi = lobe("0", "pi").phi;
    const exact::Real tiny{"1e-40"};
    for (const int d : {5, 6, 7}) {
        EXPECT_LT(abs((*polished)[d].theta.value - expected[d].theta.value), tiny) << d;
        EXPECT_LT(abs((*polished)[d].phi.value - expected[d].phi.value), tiny) << d;
        for (const Angle& angle : {(*polished)[d].theta, (*polished)[d].phi})
            EXPECT_LT(abs(exact::evaluate_closed_form(angle.text) - angle.value), tiny) << d;
    }
}

}  // namespace
}  // namespace zonal::search
