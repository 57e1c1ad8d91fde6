#pragma once

#include <optional>

#include "search/course.hpp"
#include "search/genetic.hpp"

namespace zonal::search {

/// How long and in which way lobes are sought.
struct SearchSettings {
    std::uint64_t seed = 1;
    int generations = 0;  ///< 0: no limit
    double seconds = 0;   ///< stops earlier; 0: no limit
    // With neither: until the best has not improved for `genetic.stall_generations`.
    int islands = 4;  ///< fixed, so that the result does not depend on the machine's cores
    int generations_between_exchanges = 10;
    std::vector<int> zero_bands;  ///< whose zeros are candidates; empty: those of `usual_zero_bands`
    std::vector<int> rings;       ///< meridians of the pool; empty: those of `usual_rings`
    bool leaves_grid = true;      ///< refines the best sets off the grid
    Objective objective;
    Genetic genetic;
    std::optional<AngledSet> start;  ///< lobes to begin from
};

struct SearchResult {
    Solution best;                ///< confirmed at 50 digits; no lobes when only singular sets were met
    std::vector<Solution> front;  ///< of all confirmed sets, those that no other beats in nonzeros,
                                  ///< multiplications and condition at once; fewest nonzeros first
    Progress progress;
};

/// Sparse lobes for the bands of a problem, by genetic algorithms on islands that exchange their best. The
/// same settings and number of generations give the same result, whatever the timing of threads. `stop`, once
/// true, ends the search after the present generation.
SearchResult search_lobes(const Problem& problem, const SearchSettings& settings,
                          const std::atomic<bool>& stop, const SearchObserver& observer = {});

}  // namespace zonal::search
