#pragma once

#include "search/column_sums.hpp"
#include "search/pool.hpp"
#include "search/random.hpp"
#include "search/score.hpp"

namespace zonal::search {

/// How a set of lobes is improved by swaps.
struct Annealing {
    int moves = 1000;
    double start_temperature = 1.5;  ///< in nonzeros
    double end_temperature = 0.15;
    double norm_weight = 1.0;  ///< lambda: of log2(||Â_l||_F ||Y_l||_F / (2l+1)), summed over the bands
};

/// The inverses Â_l of all bands of a problem, kept up to date while one lobe after another is replaced.
/// Replacing row d of Y by r is a rank-one change: with w = r Â, column d of the inverse becomes Â_d / w_d,
/// and every other column j loses w_j times that (Sherman and Morrison). Errors grow by 1/|w_d|, so small
/// pivots are refused and the inverses are computed afresh now and then.
///
/// The energy is what can be counted in one pass over Â: the nonzeros and norm_weight times
/// log2(||Â_l||_F ||Y_l||_F / (2l+1)), summed over the bands.
class TrackedInverses {
  public:
    TrackedInverses(const Problem& problem, const CandidateGrid& grid, const Objective& objective,
                    double norm_weight);

    const Problem& problem() const { return *problem_; }

    /// Starts from these lobes. False when they are singular: then no other function may be called.
    bool reset(const LobeSet& lobes);

    const LobeSet& lobes() const { return lobes_; }
    double energy() const { return energy_; }
    exact::Matrix<double> a_hat(int band_index) const {
        return bands_[band_index].a_hat.topRows(bands_[band_index].size);
    }

    /// Energy after replacing the lobe at `position`, or after exchanging the lobes at `position < other`;
    /// infinite when a pivot is too small. Gives up, with infinity, as soon as it must exceed `limit`.
    double try_replace(int position, Lobe lobe, double limit);
    double try_exchange(int position, int other, double limit);

    /// Makes the last tried change, whose energy must have been finite.
    /// False where a fresh inversion finds the lobes singular: then the energy is infinite until `reset`.
    bool accept();

  private:
    struct Band {
        int l = 0, size = 0;
        exact::Matrix<double> a_hat;         // columns padded with zeros to whole packs
        exact::Vector<double> row, weights;  // padded too
        double energy = 0, trial_energy = 0;
        bool is_changed = false;  // by the last tried change
    };

    double try_change(int position, Lobe lobe, int first_size_that_has_both, double limit);
    void replace_row(Band& band) const;
    double energy_of(const Band& band, const ColumnSums& sums) const;
    bool invert_afresh();

    const Problem* problem_;
    const CandidateGrid* grid_;
    Objective objective_;
    double norm_weight_;
    std::vector<Band> bands_;
    LobeSet lobes_;
    double energy_ = 0, trial_energy_ = 0;
    int position_ = 0, other_ = -1;
    Lobe lobe_;
    int accepted_since_refresh_ = 0;
};

/// Improves a set by swaps under a falling temperature; returns the best set it met. Precondition: `state`
/// was reset to a regular set.
LobeSet anneal_by_swaps(TrackedInverses& state, const CandidateGrid& grid, const Pool& pool,
                        const Annealing& settings, Random& random);

}  // namespace zonal::search
