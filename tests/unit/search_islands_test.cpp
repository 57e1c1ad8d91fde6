#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "search/progress_text.hpp"
#include "search/search.hpp"
#include "support/lobe_sets.hpp"
#include "support/no_stop.hpp"

namespace zonal::search {
namespace {

SearchSettings settings_for(const Problem& problem, int generations) {
    SearchSettings settings;
    settings.generations = generations;
    settings.genetic = Genetic::with_local_steps(problem);
    return settings;
}

TEST(Search, same_seed_and_generations_give_the_same_lobes) {
    const Problem problem = Problem::shared(4);
    SearchSettings settings = settings_for(problem, 5);
    settings.genetic.population = 10;
    settings.genetic.local_step.moves = 400;
    settings.generations_between_exchanges = 2;
    const SearchResult first = search_lobes(problem, settings, kNoStop);
    const SearchResult second = search_lobes(problem, settings, kNoStop);
    EXPECT_EQ(texts_of(first.best.lobes), texts_of(second.best.lobes));
    EXPECT_EQ(first.progress.evaluations, second.progress.evaluations);
    settings.seed = 2;
    EXPECT_NE(texts_of(search_lobes(problem, settings, kNoStop).best.lobes), texts_of(first.best.lobes));
}

TEST(Search, reaches_the_best_known_order_4) {
    const Problem problem = Problem::shared(4);
    const SearchResult result = search_lobes(problem, settings_for(problem, 6), kNoStop);
    EXPECT_EQ(result.best.score.nonzeros, 28);
    EXPECT_LT(result.best.score.condition, 5);
}

TEST(Search, raised_stop_flag_ends_after_one_generation_and_keeps_the_best) {
    const Problem problem = Problem::shared(4);
    const std::atomic<bool> stop = true;
    const SearchResult result = search_lobes(problem, settings_for(problem, 1000), stop);
    EXPECT_EQ(result.progress.generation, 1);
    EXPECT_EQ(result.best.lobes.size(), 7);
    EXPECT_LE(result.best.score.condition, 50);
}

TEST(Search, order_2_takes_the_axes_though_it_has_no_other_candidates) {
    const Problem problem = Problem::shared(2);
    const SearchResult result = search_lobes(problem, settings_for(problem, 2), kNoStop);
    EXPECT_EQ(result.best.score.zeros, 6);
    EXPECT_NEAR(result.best.score.condition, 1, 1e-12);
}

TEST(Search, ends_by_itself_when_nothing_improves) {
    const Problem problem = Problem::shared(3);
    SearchSettings settings = settings_for(problem, 0);
    settings.genetic.stall_generations = 4;
    const SearchResult result = search_lobes(problem, settings, kNoStop);
    EXPECT_EQ(result.best.score.nonzeros, 9);
    EXPECT_GE(result.progress.generation, 5);
}

TEST(Search, resumed_is_never_worse) {
    const Problem problem = Problem::shared(4);
    const SearchResult first = search_lobes(problem, settings_for(problem, 4), kNoStop);
    SearchSettings settings = settings_for(problem, 1);
    settings.genetic.local_step.moves = 1;
    settings.start = first.best.lobes;
    const SearchResult resumed = search_lobes(problem, settings, kNoStop);
    EXPECT_LE(resumed.best.score.cost({}), first.best.score.cost({}));
}

TEST(Search, front_holds_what_no_other_set_beats) {
    const Problem problem = Problem::shared(5);
    const SearchResult result = search_lobes(problem, settings_for(problem, 6), kNoStop);
    ASSERT_GE(result.front.size(), 2);
    for (const Solution& a : result.front) {
        EXPECT_LE(a.score.condition, 50);
        for (const Solution& b : result.front) {
            if (&a == &b) continue;
            EXPECT_TRUE(a.score.nonzeros < b.score.nonzeros ||
                        a.score.multiplications < b.score.multiplications ||
                        a.score.condition < b.score.condition);
        }
    }
    EXPECT_LE(result.front.front().score.nonzeros, result.best.score.nonzeros);
}

TEST(Search, finds_more_zeros_of_band_9_than_the_paper_in_a_few_generations) {
    const Problem problem = Problem::one_band(9);
    SearchSettings settings = settings_for(problem, 3);
    settings.leaves_grid = false;
    const SearchResult result = search_lobes(problem, settings, kNoStop);
    EXPECT_GE(result.best.score.zeros, 181);  // the paper: 39 % of 361
    EXPECT_LE(result.best.score.condition, 50);
}

TEST(Search, observer_hears_every_generation_and_every_gain) {
    const Problem problem = Problem::shared(4);
    int generations = 0;
    double best = std::numeric_limits<double>::infinity();
    SearchObserver observer;
    observer.on_generation = [&](const Progress& progress) { EXPECT_EQ(progress.generation, ++generations); };
    observer.on_better = [&](const Solution& solution, const Progress&) {
        EXPECT_LT(solution.score.cost({}), best + 1e-6);
        best = solution.score.cost({});
    };
    const SearchResult result = search_lobes(problem, settings_for(problem, 3), kNoStop, observer);
    EXPECT_EQ(generations, 3);
    EXPECT_EQ(best, result.best.score.cost({}));
}

TEST(ProgressText, tells_what_a_waiting_person_wants) {
    Progress progress;
    progress.generation = 12;
    progress.generations = 40;
    progress.evaluations = 3000000;
    progress.seconds = 6;
    progress.seconds_left = 14;
    progress.best.nonzeros = 28;
    progress.best.zeros = 49;
    progress.best.multiplications = 21;
    progress.best.condition = 3.922;
    EXPECT_EQ(
        progress_text(progress),
        "generation 12/40: 28 nonzeros (49 zeros), 21 multiplications, cond 3.92; 500k/s, 6 s, 14 s left");
    progress.best = {};
    EXPECT_THAT(progress_text(progress), testing::HasSubstr("singular"));
}

}  // namespace
}  // namespace zonal::search
