#pragma once

#include <limits>
#include <utility>
#include <vector>

#include "lobes/factorization.hpp"
#include "search/candidates.hpp"
#include "search/problem.hpp"

namespace zonal::search {

/// Cost of one band's Â. The emitted code computes z_d = sum over m of Â(m, d) f_m, lobe by lobe, and adds
/// the entries of a column that share |value| before it multiplies. So a column has as many instructions as
/// nonzeros and as many multiplications as distinct |values|. One common scale of the band is free, and makes
/// the commonest value 1.
struct BandCost {
    int nonzeros = 0;
    int multiplications = 0;
};

/// What a set of lobes is judged by: what the emitted sparse products cost, under a cap on the condition.
struct Objective {
    double multiplication_weight = 0.25;  ///< of a multiplication beside an instruction
    double condition_weight = 0.75;       ///< of a doubling of the worst cond_2: 50 against 20 is one nonzero
    double condition_cap = 50;            ///< on cond_2 of every band

    /// Band 1 rotates as a vector and its lobes are seldom used (the paper does not count them), so its
    /// nonzeros weigh no more than multiplications.
    double cost_of_band(int l, const BandCost& band) const {
        const double nonzero_weight = l >= 2 ? 1.0 : multiplication_weight;
        return nonzero_weight * band.nonzeros + multiplication_weight * band.multiplications;
    }
};

/// `a_hat` is column-major, size x size. |a| < `kZeroInDouble` is zero; |values| closer than a factor of
/// 1 + `kZeroInDouble` are equal. Fast but provisional: the 50-digit twin below decides.
BandCost band_cost(const double* a_hat, int size);
inline constexpr double kZeroInDouble = 1e-9;

/// A band whose ||Â_l||_F^2 in double is not below this is singular. (The ideal is 4 pi.)
inline constexpr double kSingularSquaredNorm = 1e10;

/// `band_cost` at 50 digits, with entries zero and |values| equal below `exact::kZeroThreshold`.
BandCost band_cost(const exact::Matrix<exact::Real>& a_hat);

/// Judges a set of lobes. Smaller cost is better; a singular set is worse than any other.
struct Score {
    int zeros = 0;     ///< of all bands of the problem
    int nonzeros = 0;  ///< of bands >= 2
    int multiplications = 0;
    std::vector<std::pair<int, BandCost>> bands;                 ///< each band and its cost
    double condition = std::numeric_limits<double>::infinity();  ///< largest cond_2 of a band
    double norm = std::numeric_limits<double>::infinity();       ///< largest ||Â_l||_2

    bool is_singular() const { return condition == std::numeric_limits<double>::infinity(); }
    bool is_allowed(const Objective& objective) const { return condition <= objective.condition_cap; }

    /// The number the search minimises. Over the cap: worse than any allowed set, the more the farther over.
    double cost(const Objective& objective) const;
};

/// Afresh, in double, by inverting every band.
Score score(const Problem& problem, const CandidateGrid& grid, const LobeSet& lobes);

/// Afresh, at 50 digits.
Score exact_score(const Problem& problem, const std::vector<exact::Direction<exact::Real>>& directions);

/// Components other than 0 and ±1 of all directions: what turning the lobes costs. Breaks ties.
int turning_cost(const std::vector<exact::Direction<exact::Real>>& directions);

}  // namespace zonal::search
