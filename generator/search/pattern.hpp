#pragma once

#include <vector>

#include "exact/matrix.hpp"
#include "search/problem.hpp"

namespace zonal::search {

/// What is worth keeping while lobes leave the grid: Â(row, column) = sign * Â(other_row, column) in one
/// band, or Â(row, column) = 0 when `other_row` is negative.
struct Relation {
    int band_index = 0;
    int row = 0, column = 0;
    int other_row = -1;
    int sign = 0;

    template <class S>
    S residual(const exact::Matrix<S>& a_hat) const {
        const S value = a_hat(row, column);
        return other_row < 0 ? value : S(value - sign * a_hat(other_row, column));
    }
};

using Pattern = std::vector<Relation>;

/// The zeros of bands given by their inverses, in the order of the problem's bands.
Pattern zeros_of(const std::vector<exact::Matrix<double>>& a_hats);

/// The entries of bands >= 2 that are not zero, as relations that would make them so.
Pattern nonzeros_of(const Problem& problem, const std::vector<exact::Matrix<double>>& a_hats);

/// The pairs of entries of one column that share |value| other than zero.
Pattern equalities_of(const std::vector<exact::Matrix<double>>& a_hats);

}  // namespace zonal::search
