#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "kernels/lobes.hpp"
#include "kernels/order_kernels.hpp"
#include "lobes/lobe_table.hpp"
#include "search/orbit_search.hpp"
#include "support/no_stop.hpp"

namespace zonal::search {
namespace {

using testing::Each;
using testing::Ge;

struct Orbits {
    CandidateGrid grid;
    Pool pool;
    OrbitPool orbits;

    Orbits(int l, int mirrors) : grid(l), pool(grid, {2 * mirrors, 8}), orbits(grid, pool, mirrors) {}
};

/// The direction behind the plane through the z axis at `angle`.
exact::Direction<double> mirrored(const exact::Direction<double>& direction, double angle) {
    const exact::Direction<double> normal(-std::sin(angle), std::cos(angle), 0);
    return direction - 2 * direction.dot(normal) * normal;
}

bool has_axis(const std::vector<exact::Direction<double>>& axes, const exact::Direction<double>& axis) {
    return std::ranges::any_of(
        axes, [&](const exact::Direction<double>& each) { return std::abs(each.dot(axis)) > 1 - 1e-12; });
}

std::vector<exact::Direction<double>> axes_of(const CandidateGrid& grid, const LobeSet& lobes) {
    std::vector<exact::Direction<double>> axes;
    for (const Lobe lobe : lobes) axes.push_back(grid.direction(lobe).cast<double>());
    return axes;
}

class OrbitPoolOfMirrors : public testing::TestWithParam<int> {};

TEST_P(OrbitPoolOfMirrors, holds_the_mirror_image_of_every_lobe) {
    const int mirrors = GetParam();
    const Orbits all(5, mirrors);
    for (int number = 0; number < all.orbits.size(); ++number) {
        const std::vector<exact::Direction<double>> axes = axes_of(all.grid, all.orbits[number].lobes);
        for (int mirror = 0; mirror < mirrors; ++mirror)
            for (const auto& axis : axes)
                EXPECT_TRUE(has_axis(axes, mirrored(axis, mirror * M_PI / mirrors))) << "orbit " << number;
    }
}

TEST_P(OrbitPoolOfMirrors, holds_no_lobe_in_two_orbits) {
    const Orbits all(5, GetParam());
    std::set<Lobe> lobes;
    int count = 0;
    for (int number = 0; number < all.orbits.size(); ++number) {
        lobes.insert(all.orbits[number].lobes.begin(), all.orbits[number].lobes.end());
        count += all.orbits[number].size();
    }
    EXPECT_EQ(static_cast<int>(lobes.size()), count);
    EXPECT_GT(all.orbits.size(), 20);
}

/// The irreducible representation of a harmonic: |m| modulo the turns, folded, and even or odd.
int representation(int m, int mirrors) {
    const int turns = std::abs(m) % mirrors;
    return 2 * std::min(turns, mirrors - turns) + (m < 0);
}

TEST_P(OrbitPoolOfMirrors, fourier_sums_over_an_orbit_see_one_representation_each) {
    const int mirrors = GetParam();
    for (const int l : {6, 7}) {
        const Orbits all(l, mirrors);
        for (int number = 0; number < all.orbits.size(); ++number) {
            const Orbit& orbit = all.orbits[number];
            exact::Matrix<double> lobes(2 * l + 1, orbit.size());
            for (int i = 0; i < orbit.size(); ++i) {
                all.grid.evaluate(l, orbit.lobes[i], lobes.col(i).data());
                if (l % 2 != 0) lobes.col(i) *= orbit.signs[i];
            }
            const exact::Matrix<double> sums = lobes * fourier_sums(orbit, l % 2 != 0).rows.transpose();
            for (int sum = 0; sum < orbit.size(); ++sum) {
                std::set<int> seen;
                for (int m = -l; m <= l; ++m)
                    if (std::abs(sums(l + m, sum)) > 1e-9) seen.insert(representation(m, mirrors));
                // On mirrors that hold no first lobe of an orbit, sums see even and odd functions together.
                EXPECT_LE(seen.size(), orbit.has_pairs || mirrors <= 2 ? 1u : 2u)
                    << "band " << l << " orbit " << number << " sum " << sum;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(mirrors, OrbitPoolOfMirrors, testing::Range(1, kMostMirrors + 1));

TEST(OrbitPool, knows_the_orbits_of_a_whole_set_only) {
    const Orbits all(4, 2);
    LobeSet lobes = all.orbits[3].lobes;
    lobes.insert(lobes.end(), all.orbits[7].lobes.begin(), all.orbits[7].lobes.end());
    EXPECT_EQ(all.orbits.orbits_of(lobes), (std::vector<int>{3, 7}));
    int divided = 0;
    while (all.orbits[divided].size() == 1) ++divided;
    lobes = all.orbits[divided].lobes;
    lobes.pop_back();
    EXPECT_EQ(all.orbits.orbits_of(lobes), std::nullopt);
}

TEST(FourierSums, are_orthogonal) {
    for (int steps = 1; steps <= kMostMirrors; ++steps) {
        for (const bool has_pairs : {false, true}) {
            for (const bool is_odd_band : {false, true}) {
                Orbit orbit{LobeSet(has_pairs ? 2 * steps : steps), {}, steps, has_pairs, true};
                exact::Matrix<double> products = fourier_sums(orbit, is_odd_band).rows;
                products *= products.transpose().eval();
                EXPECT_THAT(products.diagonal().reshaped(), Each(Ge(0.99)));
                products.diagonal().setZero();
                EXPECT_LT(products.norm(), 1e-12) << steps << " steps";
            }
        }
    }
}

int instructions(const BandFactorization& band) { return kernels::factorization_counts(band).instructions(); }

SearchSettings settings_for(int generations) {
    SearchSettings settings;
    settings.generations = generations;
    return settings;
}

TEST(OrbitSearch, same_seed_and_generations_give_the_same_closed_lobes) {
    SearchSettings settings = settings_for(3);
    const OrbitSettings orbits{2, 500};
    const SearchResult first = search_orbits(3, settings, orbits, instructions, kNoStop);
    const SearchResult second = search_orbits(3, settings, orbits, instructions, kNoStop);
    ASSERT_EQ(first.best.lobes.size(), 7u);
    EXPECT_EQ(first.progress.instructions, second.progress.instructions);
    EXPECT_EQ(first.progress.evaluations, second.progress.evaluations);
    std::vector<exact::Direction<double>> axes;
    for (const AngledLobe& lobe : first.best.lobes) axes.push_back(lobe.direction().cast<double>());
    for (std::size_t i = 0; i < axes.size(); ++i) {
        EXPECT_EQ(second.best.lobes[i].direction(), first.best.lobes[i].direction());
        for (const double mirror : {0.0, M_PI / 2}) EXPECT_TRUE(has_axis(axes, mirrored(axes[i], mirror)));
    }
}

/// The sparsest lobes of band 4, with more zeros, take 25.
TEST(OrbitSearch, finds_cheaper_products_of_band_4_than_the_sparsest_lobes) {
    const SearchResult result = search_orbits(4, settings_for(8), {1, 2000}, instructions, kNoStop);
    EXPECT_LE(result.progress.instructions, 24);
    EXPECT_EQ(result.progress.instructions,
              instructions(factorize_band(4, directions_of(result.best.lobes))));
    EXPECT_LE(result.best.score.condition, 50);
}

TEST(OrbitSearch, resumed_is_never_worse) {
    const SearchResult first = search_orbits(4, settings_for(4), {2, 1000}, instructions, kNoStop);
    SearchSettings settings = settings_for(1);
    settings.seed = 2;
    settings.start = first.best.lobes;
    int improvements = 0;
    SearchObserver observer;
    observer.on_better = [&](const Solution&, const Progress&) { ++improvements; };
    const SearchResult second = search_orbits(4, settings, {2, 1}, instructions, kNoStop, observer);
    const auto cost = [&](const SearchResult& result) {
        return result.progress.instructions +
               settings.objective.condition_weight * std::log2(result.best.score.condition);
    };
    EXPECT_LE(cost(second), cost(first) + 1e-9);
    EXPECT_EQ(improvements > 0, cost(second) < cost(first) - 1e-9);
}

TEST(OrbitSearch, refuses_to_resume_from_lobes_of_other_mirrors) {
    SearchSettings settings = settings_for(1);
    settings.start = search_orbits(4, settings_for(1), {1, 100}, instructions, kNoStop).best.lobes;
    EXPECT_THROW(search_orbits(4, settings, {3, 100}, instructions, kNoStop), std::invalid_argument);
}

/// Mirrors of which no orbits make up 2l+1 independent lobes.
TEST(OrbitSearch, ends_without_lobes_where_there_are_none) {
    const SearchResult result = search_orbits(3, settings_for(100), {4, 10}, instructions, kNoStop);
    EXPECT_EQ(result.progress.generation, 1);
    EXPECT_TRUE(result.best.score.is_singular());
    EXPECT_TRUE(result.best.lobes.empty());
}

class MirroredTableOfABand : public testing::TestWithParam<int> {};

TEST_P(MirroredTableOfABand, is_verified_and_costs_less_than_the_sparsest_lobes) {
    const auto committed = [](const LobeUse& use) {
        return read_lobe_table(std::filesystem::path(ZONAL_TABLES_DIR) / use.table_path(), use);
    };
    const LobeUse use = LobeUse::band(GetParam(), TableRole::band_mirrored);
    const LobeTable mirrored = committed(use), sparsest = committed(LobeUse::band(GetParam()));
    EXPECT_THAT(mirrored.command, testing::HasSubstr("--out generator/tables/" + use.table_path().string()));
    EXPECT_LT(instructions(mirrored.bands[0]), instructions(sparsest.bands[0]));
}

TEST(PerBandLobes, are_those_of_the_cheaper_table) {
    const OrderKernels order = build_order_kernels(6, {});
    ASSERT_EQ(order.tables.per_band.size(), 4);
    for (const TablePointer& source : order.tables.per_band) {
        // Below band 4 there is one table.
        const LobeUse& use = source->table.use;
        EXPECT_EQ(use.role, use.value >= 4 ? TableRole::band_mirrored : TableRole::band) << source->name;
    }
}

INSTANTIATE_TEST_SUITE_P(bands, MirroredTableOfABand, testing::Range(4, 19));

}  // namespace
}  // namespace zonal::search
