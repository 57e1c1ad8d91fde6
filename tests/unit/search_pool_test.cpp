#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "search/pool.hpp"

namespace zonal::search {
namespace {

double phi_of(const CandidateGrid& grid, Lobe lobe) {
    return static_cast<double>(grid.phis()[lobe.phi].value);
}

TEST(Pool, of_two_rings_holds_the_coordinate_great_circles) {
    CandidateGrid grid(8, {8});
    const Pool pool(grid, {2});
    for (const Lobe lobe : pool.lobes()) {
        const double quarter_turns = phi_of(grid, lobe) / (M_PI / 2);
        const bool is_on_meridian = std::abs(quarter_turns - std::round(quarter_turns)) < 1e-12;
        EXPECT_TRUE(is_on_meridian || lobe.theta == grid.equator());
    }
    // The pole once, and four of every theta between it and the equator.
    const auto at_pole = std::ranges::count(pool.lobes(), grid.pole(), &Lobe::theta);
    const auto on_equator = std::ranges::count(pool.lobes(), grid.equator(), &Lobe::theta);
    EXPECT_EQ(at_pole, 1);
    EXPECT_EQ(pool.size(), 1 + on_equator + 4 * (static_cast<int>(grid.thetas().size()) - 2));
}

/// A function that vanishes at every candidate makes every set singular.
TEST(UsualRings, see_every_function_of_every_band) {
    for (int l = 2; l < 20; ++l) {
        CandidateGrid grid(l, usual_zero_bands({l}));
        const Pool pool(grid, usual_rings({l}));
        std::vector<double> largest(2 * l + 1, 0.0), row(2 * l + 1);
        for (const Lobe lobe : pool.lobes()) {
            grid.evaluate(l, lobe, row.data());
            for (int k = 0; k <= 2 * l; ++k) largest[k] = std::max(largest[k], std::abs(row[k]));
        }
        EXPECT_GT(std::ranges::min(largest), 0.1) << "band " << l;
    }
}

TEST(UsualRings, of_shared_lobes_see_every_function) {
    for (int order = 3; order <= 20; ++order) {
        std::vector<int> bands;
        for (int l = 1; l < order; ++l) bands.push_back(l);
        CandidateGrid grid(order - 1, usual_zero_bands(bands));
        const Pool pool(grid, usual_rings(bands));
        const int l = order - 1;
        std::vector<double> largest(2 * l + 1, 0.0), row(2 * l + 1);
        for (const Lobe lobe : pool.lobes()) {
            grid.evaluate(l, lobe, row.data());
            for (int k = 0; k <= 2 * l; ++k) largest[k] = std::max(largest[k], std::abs(row[k]));
        }
        EXPECT_GT(std::ranges::min(largest), 0.1) << "order " << order;
    }
}

TEST(Pool, draws_keep_the_angle_that_was_asked_for) {
    CandidateGrid grid(5);
    const Pool pool(grid, {4, 6});
    Random random(1, 0);
    std::set<Lobe> parallels, meridians;
    for (int trial = 0; trial < 200; ++trial) {
        const Lobe lobe = pool.draw(random);
        EXPECT_TRUE(pool.contains(lobe));
        EXPECT_EQ(pool.draw_on_parallel(lobe, random).theta, lobe.theta);
        EXPECT_EQ(pool.draw_on_meridian(lobe, random).phi, lobe.phi);
    }
}

TEST(Pool, holds_an_added_lobe_once) {
    CandidateGrid grid(3);
    Pool pool(grid, {2});
    const Lobe lobe = grid.canonical(grid.add_theta({exact::Real{"0.6"}, "0.6"}), 1);
    EXPECT_FALSE(pool.contains(lobe));
    const int before = pool.size();
    pool.add(lobe);
    pool.add(lobe);
    EXPECT_TRUE(pool.contains(lobe));
    EXPECT_EQ(pool.size(), before + 1);
}

}  // namespace
}  // namespace zonal::search
