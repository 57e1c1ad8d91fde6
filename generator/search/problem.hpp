#pragma once

#include <vector>

namespace zonal::search {

/// What lobes are sought for: some bands, each of which uses the first 2l+1 lobes of one set.
struct Problem {
    std::vector<int> bands;  ///< ascending
    int lobe_count = 0;

    int highest_band() const { return bands.back(); }

    /// One band with lobes of its own. Source: Nowrouzezahrai et al., section 5.
    static Problem one_band(int l) { return {{l}, 2 * l + 1}; }

    /// All bands of an order with shared lobes. Source: section 6.
    static Problem shared(int order) {
        Problem problem{{}, 2 * order - 1};
        for (int l = 1; l < order; ++l) problem.bands.push_back(l);
        return problem;
    }
};

}  // namespace zonal::search
