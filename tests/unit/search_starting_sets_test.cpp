#include <gtest/gtest.h>

#include <algorithm>

#include "search/score.hpp"
#include "search/starting_sets.hpp"

namespace zonal::search {
namespace {

/// What lobes are drawn from.
struct Candidates {
    explicit Candidates(const Problem& problem, const std::vector<int>& rings)
        : grid(problem.highest_band()), pool(grid, rings) {}
    CandidateGrid grid;
    Pool pool;
};

class StartingSet : public testing::TestWithParam<int> {};

TEST_P(StartingSet, aligned_is_regular_in_every_band) {
    const Problem problem = Problem::shared(GetParam());
    const Candidates from(problem, usual_rings(problem.bands));
    Random random(GetParam(), 0);
    const LobeSet lobes = draw_aligned(problem, from.grid, from.pool, random);
    ASSERT_EQ(lobes.size(), problem.lobe_count);
    EXPECT_FALSE(score(problem, from.grid, lobes).is_singular());
}

TEST_P(StartingSet, aligned_has_two_lobes_on_the_equator_for_every_odd_band) {
    const Problem problem = Problem::shared(GetParam());
    const Candidates from(problem, usual_rings(problem.bands));
    Random random(GetParam(), 0);
    const LobeSet lobes = draw_aligned(problem, from.grid, from.pool, random);
    for (const int l : problem.bands) {
        const auto on_equator = std::count_if(lobes.begin(), lobes.begin() + 2 * l + 1, [&](const Lobe lobe) {
            return lobe.theta == from.grid.equator();
        });
        EXPECT_EQ(on_equator, l % 2 == 1 ? l + 1 : l) << "band " << l;
    }
}

TEST_P(StartingSet, aligned_has_a_lobe_on_one_great_circle_for_every_even_band) {
    const Problem problem = Problem::shared(GetParam());
    const Candidates from(problem, usual_rings(problem.bands));
    Random random(GetParam(), 0);
    const LobeSet lobes = draw_aligned(problem, from.grid, from.pool, random);
    for (int l = 2; l <= problem.highest_band(); l += 2)
        EXPECT_NEAR(static_cast<double>(from.grid.direction(lobes[2 * l - 1])[1]), 0, 1e-12) << "band " << l;
}

TEST_P(StartingSet, regular_is_so_in_the_highest_band) {
    const int l = GetParam() - 1;
    const Problem problem = Problem::one_band(l);
    const Candidates from(problem, usual_rings(problem.bands));
    Random random(GetParam(), 0);
    EXPECT_FALSE(
        score(problem, from.grid, draw_regular(problem, from.grid, from.pool, random)).is_singular());
}

INSTANTIATE_TEST_SUITE_P(orders, StartingSet, testing::Values(9, 10, 13, 16, 20));

/// Two meridians do not see sin(2 phi) of odd l off the equator: no set of this pool is regular.
TEST(StartingSetOfASmallPool, is_complete_all_the_same) {
    const Problem problem = Problem::shared(9);
    const Candidates from(problem, {2});
    Random random(1, 0);
    EXPECT_EQ(draw_aligned(problem, from.grid, from.pool, random).size(), problem.lobe_count);
}

/// Band 1 has Legendre zeros at the pole and on the equator alone.
TEST(StartingSetOfASmallPool, is_complete_though_all_lobes_lie_on_the_equator) {
    const Problem problem = Problem::shared(9);
    CandidateGrid grid(problem.highest_band(), {1});
    const Pool pool(grid, usual_rings(problem.bands));
    Random random(1, 0);
    EXPECT_EQ(draw_aligned(problem, grid, pool, random).size(), problem.lobe_count);
}

}  // namespace
}  // namespace zonal::search
