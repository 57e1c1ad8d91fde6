#pragma once

#include <atomic>

#include "search/search.hpp"

namespace zonal::search {

/// Sparser lobes than those of `settings.start`, anywhere on the sphere. Walkers, one for each island, ruin
/// and recreate the zeros of Â (`AngleWalk`), each at a temperature of its own; what one finds is polished
/// and confirmed at 50 digits, and now and then all go on from the best of all. `moves`: of a walker in a
/// generation; 0: by the number of lobes. Of the settings, those of the genetic algorithm but for its
/// stall, and of its candidates, do not count. The same settings and number of generations give the same
/// result, which is never worse than the start. Precondition: a start whose bands are regular.
SearchResult search_off_grid(const Problem& problem, const SearchSettings& settings, int moves,
                             const std::atomic<bool>& stop, const SearchObserver& observer = {});

}  // namespace zonal::search
