#include <gtest/gtest.h>

#include "graph/counts.hpp"
#include "graph/passes.hpp"
#include "kernels/lobes.hpp"
#include "lobes/lobe_table.hpp"

namespace zonal::kernels {
namespace {

std::filesystem::path tables() { return std::filesystem::path(ZONAL_SOURCE_DIR) / "generator/tables"; }

LobeTable table_of(const LobeUse& use) { return read_lobe_table(tables() / use.table_path(), use); }

LobeSet shared_lobes(int order) { return LobeSet::shared(table_of(LobeUse::order(order))); }

TEST(Factorize, multiplications_of_its_bands_are_those_of_the_kernel) {
    const LobeSet lobes = shared_lobes(6);
    int multiplications = 0;
    for (const BandFactorization& band : lobes.bands)
        multiplications += factorization_counts(band).multiplications();
    const graph::Counts kernel = graph::count_operations(graph::optimize(build_factorize(lobes))).total();
    EXPECT_EQ(multiplications, kernel.multiplications());
}

TEST(Factorize, multiplies_at_most_17_times_for_20_nonzeros_of_a_band) {
    for (int l = 2; l <= 10; ++l) {
        const BandFactorization band = table_of(LobeUse::band(l)).bands.front();
        EXPECT_LE(20 * factorization_counts(band).multiplications(), 17 * band.nonzeros()) << "band " << l;
    }
}

/// Of bands >= 2.
TEST(Factorize, multiplies_at_most_17_times_for_20_nonzeros_of_an_order) {
    for (int order = 3; order <= 11; ++order) {
        const LobeSet lobes = shared_lobes(order);
        int multiplications = 0, entries = 0;
        for (const BandFactorization& band : lobes.bands) {
            if (band.band < 2) continue;
            multiplications += factorization_counts(band).multiplications();
            entries += band.nonzeros();
        }
        EXPECT_LE(20 * multiplications, 17 * entries) << "order " << order;
    }
}

TEST(LobeSet, weights_of_a_ring_are_all_lobes_of_every_band) {
    const LobeSet ring = LobeSet::ring(5);
    EXPECT_EQ(ring.weight_start(0), 0);
    EXPECT_EQ(ring.weight_start(3), 27);
    EXPECT_EQ(ring.weight_start(5), 45);
    EXPECT_EQ(ring.directions.size(), 9);
}

TEST(LobeSet, every_band_has_lobes_of_its_own) {
    const LobeTable band_2 = table_of(LobeUse::band(2));
    const LobeSet lobes = LobeSet::per_band({&band_2});
    EXPECT_EQ(lobes.order, 3);
    EXPECT_EQ(lobes.directions.size(), 9);
    EXPECT_EQ(lobes.lobes_of[2], (std::vector<int>{4, 5, 6, 7, 8}));
    EXPECT_EQ(lobes.bands[2].zeros, 16);
}

}  // namespace
}  // namespace zonal::kernels
