// Local search over sets of lobes: swap one lobe, judge by the inverse updated by rank one, accept by
// temperature (Metropolis). Every swap is drawn to keep the structure that makes zeros: the same theta, the
// same phi, an angle of another lobe, the mirror image of another lobe; or, for shared lobes, another
// position, since band l sees only the first 2l+1.

#include "search/swap_annealing.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

namespace zonal::search {
namespace {

constexpr double kSmallestPivot = 0.03;
constexpr int kAcceptedBeforeRefresh = 16;
constexpr double kNever = std::numeric_limits<double>::infinity();

}  // namespace

TrackedInverses::TrackedInverses(const Problem& problem, const CandidateGrid& grid,
                                 const Objective& objective, double norm_weight)
    : problem_(&problem), grid_(&grid), objective_(objective), norm_weight_(norm_weight) {
    for (const int l : problem.bands) {
        Band band;
        band.l = l;
        band.size = 2 * l + 1;
        const int rows = (band.size + kPackedRows - 1) / kPackedRows * kPackedRows;
        band.a_hat.setZero(rows, band.size);
        band.row.setZero(rows);
        band.weights.resize(band.size);
        bands_.push_back(std::move(band));
    }
}

bool TrackedInverses::reset(const LobeSet& lobes) {
    lobes_ = lobes;
    return invert_afresh();
}

bool TrackedInverses::invert_afresh() {
    accepted_since_refresh_ = 0;
    energy_ = 0;
    for (Band& band : bands_) {
        exact::Matrix<double> columns(band.size, band.size);
        for (int d = 0; d < band.size; ++d) grid_->evaluate(band.l, lobes_[d], columns.col(d).data());
        band.a_hat.topRows(band.size) = columns.transpose().inverse();
        const ColumnSums sums = count(band.a_hat.data(), static_cast<int>(band.a_hat.rows()), band.size);
        if (!(sums.squared_norm < kSingularSquaredNorm)) {
            energy_ = std::numeric_limits<double>::infinity();  // never the best
            return false;
        }
        band.energy = energy_of(band, sums);
        energy_ += band.energy;
    }
    return true;
}

double TrackedInverses::energy_of(const Band& band, const ColumnSums& sums) const {
    // ||Y_l||_F = (2l+1) / sqrt(4 pi) for every set of directions, by the addition theorem.
    const double norm_energy = 0.5 * norm_weight_ * std::log2(sums.squared_norm / (4 * M_PI));
    return objective_.cost_of_band(band.l, {sums.nonzeros, 0}) + norm_energy;
}

/// Makes the change whose weights are known.
void TrackedInverses::replace_row(Band& band) const {
    const double pivot = band.weights(position_);
    band.a_hat.col(position_) /= pivot;
    for (int j = 0; j < band.size; ++j)
        if (j != position_) band.a_hat.col(j) -= band.weights(j) * band.a_hat.col(position_);
}

double TrackedInverses::try_change(int position, Lobe lobe, int first_size_that_has_both, double limit) {
    trial_energy_ = energy_;
    // The highest band first: it has most to lose.
    for (auto band = bands_.rbegin(); band != bands_.rend(); ++band) {
        band->is_changed = band->size > position && band->size < first_size_that_has_both;
        if (!band->is_changed) continue;
        const int rows = static_cast<int>(band->a_hat.rows());
        grid_->evaluate(band->l, lobe, band->row.data());
        multiply_columns(band->a_hat.data(), rows, band->size, band->row.data(), band->weights.data());
        if (!(std::abs(band->weights(position)) > kSmallestPivot)) return kNever;
        band->trial_energy = energy_of(
            *band, count_after_swap(band->a_hat.data(), rows, band->size, position, band->weights.data()));
        trial_energy_ += band->trial_energy - band->energy;
        // Bands below may still win something, but seldom more than this.
        constexpr double kHope = 6;
        if (trial_energy_ > limit + kHope) return kNever;
    }
    return trial_energy_;
}

double TrackedInverses::try_replace(int position, Lobe lobe, double limit) {
    position_ = position;
    other_ = -1;
    lobe_ = lobe;
    return try_change(position, lobe, std::numeric_limits<int>::max(), limit);
}

double TrackedInverses::try_exchange(int position, int other, double limit) {
    position_ = position;
    other_ = other;
    return try_change(position, lobes_[other], other + 1, limit);
}

bool TrackedInverses::accept() {
    for (Band& band : bands_) {
        if (band.is_changed) {
            replace_row(band);
            band.energy = band.trial_energy;
        } else if (other_ >= 0 && band.size > other_) {
            band.a_hat.col(position_).swap(band.a_hat.col(other_));
        }
    }
    if (other_ >= 0) {
        std::swap(lobes_[position_], lobes_[other_]);
    } else {
        lobes_[position_] = lobe_;
    }
    energy_ = trial_energy_;
    return ++accepted_since_refresh_ < kAcceptedBeforeRefresh || invert_afresh();
}

namespace {

/// The lobe with these angles; any where the pool does not hold it.
Lobe crossing(const CandidateGrid& grid, const Pool& pool, int theta, int phi, Random& random) {
    const Lobe lobe = grid.canonical(theta, phi);
    return pool.contains(lobe) ? lobe : pool.draw(random);
}

/// A lobe to put at `position`.
Lobe draw_replacement(const CandidateGrid& grid, const Pool& pool, const LobeSet& lobes, int position,
                      Random& random) {
    const Lobe old = lobes[position];
    const Lobe other = lobes[random.below(static_cast<int>(lobes.size()))];
    switch (random.below(8)) {
        case 0:
        case 1:
            return pool.draw(random);
        case 2:
            return pool.draw_on_parallel(old, random);
        case 3:
            return pool.draw_on_meridian(old, random);
        case 4:
            return crossing(grid, pool, other.theta, old.phi, random);
        case 5:
            return crossing(grid, pool, old.theta, other.phi, random);
        case 6:
            return grid.random_image(old, random);
        default:
            return grid.random_image(other, random);
    }
}

}  // namespace

LobeSet anneal_by_swaps(TrackedInverses& state, const CandidateGrid& grid, const Pool& pool,
                        const Annealing& settings, Random& random) {
    const Problem& problem = state.problem();
    LobeSet best = state.lobes();
    double best_energy = state.energy();
    double temperature = settings.start_temperature;
    const double cooling =
        std::pow(settings.end_temperature / settings.start_temperature, 1.0 / settings.moves);
    const bool is_shared = problem.bands.size() > 1;
    for (int move = 0; move < settings.moves; ++move, temperature *= cooling) {
        const double limit = state.energy() - temperature * std::log(1 - random.uniform());
        double energy;
        const int position = random.below(problem.lobe_count);
        if (is_shared && random.chance(0.15)) {
            const int other = random.below(problem.lobe_count);
            if (other == position) continue;
            energy = state.try_exchange(std::min(position, other), std::max(position, other), limit);
        } else {
            const Lobe lobe = draw_replacement(grid, pool, state.lobes(), position, random);
            if (lobe == state.lobes()[position]) continue;
            energy = state.try_replace(position, lobe, limit);
        }
        if (!(energy <= limit)) continue;
        if (!state.accept()) {  // rounding had hidden that it is singular
            state.reset(best);
            continue;
        }
        if (state.energy() < best_energy - 1e-9) {
            best_energy = state.energy();
            best = state.lobes();
        }
    }
    return best;
}

}  // namespace zonal::search
