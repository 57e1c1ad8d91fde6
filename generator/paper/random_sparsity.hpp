#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "search/candidates.hpp"

namespace zonal::paper {

/// Percent of zeros over many lobe sets.
struct Distribution {
    int sets = 0;
    double mean = 0, least = 0, lower_quartile = 0, median = 0, upper_quartile = 0, largest = 0;
};

/// Quartiles by linear interpolation between neighbours in rank. No values: all zero.
Distribution distribution_of(std::vector<double> values);

/// Entries of all Â_l with l >= 2 of an order, the l = 2 … N-1 of the paper's section 6.
int entries_of_order(int order);

/// Percent of zeros among them for shared lobes; none when a band from 1 on is singular. In double, zero
/// below 1e-9, as in section 5.
std::optional<double> sparsity_of(const search::CandidateGrid& grid, int order, const search::LobeSet& lobes);

struct RandomSparsity {
    Distribution distribution;
    int drawn = 0;  ///< sets, singular ones too
};

/// Figure 3, "random": sets of 2N-1 lobes drawn from the candidates of bands 1 … N-1 until `sets` are
/// nonsingular, or 20 times as many are drawn. The same for the same seed.
RandomSparsity random_sparsity(int order, int sets, std::uint64_t seed);

}  // namespace zonal::paper
