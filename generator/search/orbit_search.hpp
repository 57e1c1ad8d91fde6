#pragma once

#include <atomic>
#include <functional>

#include "lobes/factorization.hpp"
#include "search/orbits.hpp"
#include "search/search.hpp"

namespace zonal::search {

/// Instructions of the emitted product by a band's Âᵀ.
using EmittedCost = std::function<int(const BandFactorization&)>;

/// How closed sets are sought. The seed, limits, islands, pool, cap on the condition and its weight are those
/// of every search.
struct OrbitSettings {
    int mirrors = 2;  ///< planes through the z axis, see `OrbitPool`
    int moves = 0;    ///< of an annealing; 0: by the number of lobes
};

/// Lobes for one band in a set closed under mirrors, by what their emitted product costs: instructions plus
/// condition_weight * log2(cond_2). In every generation each island anneals a set of whole orbits, one or two
/// of which give way to others at a time, by an estimate of the cost: the entries that are left in Fourier
/// sums over each orbit, with the additions of these. The sets of least estimate are then factorized at 50
/// digits and their products built and counted. Ends after a generation where no whole orbits make up the
/// band. The same settings and number of generations give the same result. Throws std::invalid_argument when
/// `settings.start` is no set of whole orbits.
SearchResult search_orbits(int l, const SearchSettings& settings, const OrbitSettings& orbits,
                           const EmittedCost& emitted_cost, const std::atomic<bool>& stop,
                           const SearchObserver& observer = {});

}  // namespace zonal::search
