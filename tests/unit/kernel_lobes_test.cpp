#include <gtest/gtest.h>

#include "graph/counts.hpp"
#include "graph/passes.hpp"
#include "kernels/lobes.hpp"
#include "lobe_table.hpp"

namespace zonal::kernels {
namespace {

constexpr int kOrder = 6;

LobeSet committed_lobes() {
    const std::filesystem::path tables = std::filesystem::path(ZONAL_SOURCE_DIR) / "generator/tables";
    const LobeTable table = read_lobe_table(tables / lobe_table_name(kOrder), kOrder);
    return {kOrder, table.directions, exact::factorize_order(kOrder, table.directions)};
}

TEST(Factorize, multiplications_of_its_bands_are_those_of_the_kernel) {
    const LobeSet lobes = committed_lobes();
    int multiplications = 0;
    for (const exact::BandFactorization& band : lobes.bands)
        multiplications += factorization_multiplications(band);
    const graph::Counts kernel = graph::count_operations(graph::optimize(build_factorize(lobes))).total();
    EXPECT_EQ(multiplications, kernel.multiplications());
}

TEST(Factorize, multiplies_at_most_17_times_for_20_nonzeros) {
    const LobeSet lobes = committed_lobes();
    for (const exact::BandFactorization& band : lobes.bands) {
        if (band.band < 2) continue;
        const int nonzeros = static_cast<int>(band.a_hat.size()) - band.zeros;
        EXPECT_LE(20 * factorization_multiplications(band), 17 * nonzeros) << "band " << band.band;
    }
}

}  // namespace
}  // namespace zonal::kernels
