#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <limits>

#include "search/swap_annealing.hpp"

namespace zonal::search {
namespace {

constexpr double kAnything = std::numeric_limits<double>::infinity();

LobeSet random_regular_set(const Problem& problem, const CandidateGrid& grid, Random& random) {
    while (true) {
        LobeSet lobes;
        for (int d = 0; d < problem.lobe_count; ++d) lobes.push_back(grid.random(random));
        if (score(problem, grid, lobes).condition < 200) return lobes;
    }
}

exact::Matrix<double> fresh_inverse(const CandidateGrid& grid, int l, const LobeSet& lobes) {
    const int size = 2 * l + 1;
    exact::Matrix<double> columns(size, size);
    for (int d = 0; d < size; ++d) grid.evaluate(l, lobes[d], columns.col(d).data());
    return columns.transpose().inverse();
}

void expect_all_inverses_fresh(const Problem& problem, const CandidateGrid& grid,
                               const TrackedInverses& state) {
    for (std::size_t b = 0; b < problem.bands.size(); ++b) {
        const auto fresh = fresh_inverse(grid, problem.bands[b], state.lobes());
        EXPECT_LT((state.a_hat(static_cast<int>(b)) - fresh).norm(), 1e-9 * fresh.norm())
            << "band " << problem.bands[b];
    }
}

TEST(TrackedInverses, replaced_lobe_agrees_with_a_fresh_inverse) {
    const Problem problem = Problem::shared(5);
    const CandidateGrid grid(4);
    Random random(3, 0);
    TrackedInverses state(problem, grid, {}, 1);
    ASSERT_TRUE(state.reset(random_regular_set(problem, grid, random)));
    int accepted = 0;
    for (int trial = 0; accepted < 60 && trial < 10000; ++trial) {
        const int position = random.below(problem.lobe_count);
        const double energy = state.try_replace(position, grid.random(random), state.energy() + 3);
        if (!(energy <= state.energy() + 3)) continue;
        state.accept();
        ++accepted;
        EXPECT_NEAR(state.energy(), energy, 1e-6);
        expect_all_inverses_fresh(problem, grid, state);
    }
    EXPECT_EQ(accepted, 60);
}

TEST(TrackedInverses, exchanged_lobes_agree_with_a_fresh_inverse) {
    const Problem problem = Problem::shared(4);
    const CandidateGrid grid(3);
    Random random(4, 0);
    TrackedInverses state(problem, grid, {}, 1);
    ASSERT_TRUE(state.reset(random_regular_set(problem, grid, random)));
    int accepted = 0;
    for (int position = 0; position < 7; ++position) {
        for (int other = position + 1; other < 7; ++other) {
            const LobeSet before = state.lobes();
            if (std::isinf(state.try_exchange(position, other, kAnything))) continue;
            state.accept();
            ++accepted;
            EXPECT_EQ(state.lobes()[position], before[other]);
            EXPECT_EQ(state.lobes()[other], before[position]);
            expect_all_inverses_fresh(problem, grid, state);
        }
    }
    EXPECT_GT(accepted, 5);
}

TEST(TrackedInverses, duplicate_lobe_is_refused) {
    const Problem problem = Problem::one_band(3);
    const CandidateGrid grid(3);
    Random random(5, 0);
    TrackedInverses state(problem, grid, {}, 1);
    ASSERT_TRUE(state.reset(random_regular_set(problem, grid, random)));
    EXPECT_TRUE(std::isinf(state.try_replace(0, state.lobes()[1], kAnything)));
}

TEST(TrackedInverses, singular_start_is_refused) {
    const CandidateGrid grid(2);
    TrackedInverses state(Problem::one_band(2), grid, {}, 1);
    EXPECT_FALSE(state.reset(LobeSet(5, Lobe{})));
}

TEST(AnnealBySwaps, improves_what_it_is_given) {
    const Problem problem = Problem::shared(4);
    CandidateGrid grid(3);
    const Pool pool(grid, {4, 6});
    Random random(6, 0);
    const LobeSet start = random_regular_set(problem, grid, random);
    TrackedInverses state(problem, grid, {}, 1);
    ASSERT_TRUE(state.reset(start));
    Annealing settings;
    settings.moves = 5000;
    const LobeSet end = anneal_by_swaps(state, grid, pool, settings, random);
    EXPECT_LT(score(problem, grid, end).cost({}), score(problem, grid, start).cost({}) - 10);
}

TEST(TrackedInverses, singular_set_has_infinite_energy) {
    const Problem problem = Problem::shared(3);
    const CandidateGrid grid(2);
    Random random(3, 0);
    TrackedInverses state(problem, grid, {}, 1);
    ASSERT_TRUE(state.reset(random_regular_set(problem, grid, random)));
    EXPECT_FALSE(state.reset(LobeSet(5, grid.canonical(2, 1))));
    EXPECT_EQ(state.energy(), kAnything);
}

}  // namespace
}  // namespace zonal::search
