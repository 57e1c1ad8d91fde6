#include <gtest/gtest.h>

#include <algorithm>

#include "search/genetic.hpp"

namespace zonal::search {
namespace {

/// What a population is drawn from.
struct Candidates {
    explicit Candidates(const Problem& problem)
        : grid(problem.highest_band()), pool(grid, usual_rings(problem.bands)) {}
    CandidateGrid grid;
    Pool pool;
};

Genetic aligned(const Problem& problem) {
    Genetic settings = Genetic::with_local_steps(problem);
    settings.starts_aligned = true;
    return settings;
}

TEST(PlainGenetic, finds_most_zeros_of_band_2_as_in_the_paper) {
    const Problem problem = Problem::one_band(2);
    const Candidates from(problem);
    Population population(problem, from.grid, from.pool, {}, Genetic::of_paper(), Random(1, 0));
    for (int generation = 0; generation < 60; ++generation) population.evolve();
    EXPECT_EQ(population.best().score.zeros, 16);  // 64 % of 25
}

TEST(PlainGenetic, never_loses_its_best) {
    const Problem problem = Problem::one_band(3);
    const Candidates from(problem);
    Population population(problem, from.grid, from.pool, {}, Genetic::of_paper(), Random(2, 0));
    double best = population.best().cost;
    for (int generation = 0; generation < 20; ++generation) {
        population.evolve();
        EXPECT_LE(population.best().cost, best);
        best = population.best().cost;
    }
}

TEST(GeneticWithLocalSteps, finds_most_zeros_of_band_3_as_in_the_paper) {
    const Problem problem = Problem::one_band(3);
    const Candidates from(problem);
    Population population(problem, from.grid, from.pool, {}, Genetic::with_local_steps(problem),
                          Random(1, 0));
    for (int generation = 0; generation < 3; ++generation) population.evolve();
    EXPECT_EQ(population.best().score.zeros, 33);  // 67 % of 49
    EXPECT_LT(population.best().score.condition, 10);
}

TEST(GeneticWithLocalSteps, starts_from_regular_sets_though_the_pool_is_small) {
    const Problem problem = Problem::one_band(10);
    const Candidates from(problem);
    Genetic settings = Genetic::with_local_steps(problem);
    const Population population(problem, from.grid, from.pool, {}, settings, Random(1, 0));
    for (const Individual& individual : population.best_of_each_cost(settings.population))
        EXPECT_FALSE(individual.score.is_singular());
    EXPECT_GE(population.best_of_each_cost(settings.population).size(), 3);
}

TEST(GeneticWithLocalSteps, aligned_beats_the_paper_at_once) {
    const Problem problem = Problem::shared(9);
    const Candidates from(problem);
    Population population(problem, from.grid, from.pool, {}, aligned(problem), Random(1, 0));
    for (const Individual& individual : population.best_of_each_cost(6)) {
        const auto on_equator = std::ranges::count(individual.lobes, from.grid.equator(), &Lobe::theta);
        EXPECT_EQ(on_equator, 8);  // two for each of the bands 1, 3, 5, 7
    }
    population.evolve();
    EXPECT_LT(population.best().score.nonzeros, 570);  // Table II
}

TEST(GeneticWithLocalSteps, of_many_bands_starts_aligned) {
    EXPECT_FALSE(Genetic::with_local_steps(Problem::shared(11)).starts_aligned);
    EXPECT_TRUE(Genetic::with_local_steps(Problem::shared(12)).starts_aligned);
}

TEST(GeneticWithLocalSteps, stopped_generation_keeps_the_population) {
    const Problem problem = Problem::one_band(4);
    const Candidates from(problem);
    Population population(problem, from.grid, from.pool, {}, Genetic::with_local_steps(problem),
                          Random(1, 0));
    const double best = population.best().cost;
    const std::int64_t evaluations = population.evaluations();
    population.evolve([] { return true; });
    EXPECT_EQ(population.best().cost, best);
    EXPECT_EQ(population.evaluations(), evaluations);
}

/// The first generation anneals founders and must not lose what a search resumes from.
TEST(Population, of_founders_keeps_an_adopted_set) {
    const Problem problem = Problem::shared(9);
    const Candidates from(problem);
    Population source(problem, from.grid, from.pool, {}, aligned(problem), Random(1, 0));
    for (int generation = 0; generation < 2; ++generation) source.evolve();
    Population target(problem, from.grid, from.pool, {}, aligned(problem), Random(2, 0));
    target.adopt(source.best().lobes);
    target.evolve();
    EXPECT_LE(target.best().cost, source.best().cost);
}

TEST(Population, adopts_a_better_set_as_its_best) {
    const Problem problem = Problem::one_band(3);
    const Candidates from(problem);
    Population source(problem, from.grid, from.pool, {}, Genetic::with_local_steps(problem), Random(1, 0));
    source.evolve();
    Population target(problem, from.grid, from.pool, {}, Genetic::of_paper(), Random(3, 0));
    ASSERT_GT(target.best().cost, source.best().cost);
    target.adopt(source.best().lobes);
    EXPECT_EQ(target.best().cost, source.best().cost);
}

TEST(Population, stalls_only_after_the_generations_asked_for) {
    const Problem problem = Problem::one_band(2);
    const Candidates from(problem);
    Genetic settings = Genetic::with_local_steps(problem);
    settings.stall_generations = 3;
    Population population(problem, from.grid, from.pool, {}, settings, Random(1, 0));
    int generations = 0;
    while (!population.has_stalled()) {
        population.evolve();
        ++generations;
    }
    EXPECT_EQ(population.stalled(), 3);
    EXPECT_GE(generations, 3);
    population.restart();
    EXPECT_FALSE(population.has_stalled());
}

}  // namespace
}  // namespace zonal::search
