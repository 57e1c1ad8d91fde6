// Local search over sets of lobes: swap one lobe, judge by the inverse updated by rank one, accept by
// temperature (Metropolis). Every swap is drawn to keep the structure that makes zeros: the same theta, the
// same phi, an angle of another lobe, the mirror image of another lobe; or, for shared lobes, another
// position, since band l sees only the first 2l+1.

#include "search/swap_annealing.hpp"

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
    : grid_(&grid), objective_(objective), norm_weight_(norm_weight) {
    for (const int l : problem.bands) {
        Band band;
        band.l = l;
        band.size = 2 * l + 1;
        band.a_hat.resize(band.size, band.size);
        band.trial.resize(band.size, band.size);
        band.row.resize(band.size);
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
        band.a_hat = columns.transpose().inverse();
        if (!(band.a_hat.squaredNorm() < kSingularSquaredNorm)) return false;
        band.energy = band_energy(band, band.a_hat, kNever);
        energy_ += band.energy;
    }
    return true;
}

double TrackedInverses::band_energy(const Band& band, const exact::Matrix<double>& a_hat,
                                    double limit) const {
    // ||Y_l||_F = (2l+1) / sqrt(4 pi) for every set of directions, by the addition theorem.
    const double norm_energy = 0.5 * norm_weight_ * std::log2(a_hat.squaredNorm() / (4 * M_PI));
    BandCost cost;
    cost.nonzeros = static_cast<int>((a_hat.array().abs() >= kZeroInDouble).count());
    if (norm_energy + objective_.cost_of_band(band.l, cost) > limit) return kNever;
    return norm_energy + objective_.cost_of_band(band.l, band_cost(a_hat.data(), band.size));
}

bool TrackedInverses::replace_row(Band& band, int position, Lobe lobe) const {
    grid_->evaluate(band.l, lobe, band.row.data());
    band.weights.noalias() = band.a_hat.transpose() * band.row;
    const double pivot = band.weights(position);
    if (!(std::abs(pivot) > kSmallestPivot)) return false;
    const double* old_column = band.a_hat.col(position).data();
    for (int j = 0; j < band.size; ++j) {
        const double* from = band.a_hat.col(j).data();
        double* to = band.trial.col(j).data();
        if (j == position) {
            for (int i = 0; i < band.size; ++i) to[i] = from[i] / pivot;
        } else {
            const double factor = band.weights(j) / pivot;
            for (int i = 0; i < band.size; ++i) to[i] = from[i] - factor * old_column[i];
        }
    }
    return true;
}

double TrackedInverses::try_change(int position, Lobe lobe, int first_size_that_has_both, double limit) {
    trial_energy_ = energy_;
    // The highest band first: it has most to lose.
    for (auto band = bands_.rbegin(); band != bands_.rend(); ++band) {
        band->is_changed = band->size > position && band->size < first_size_that_has_both;
        if (!band->is_changed) continue;
        if (!replace_row(*band, position, lobe)) return kNever;
        const double others = trial_energy_ - band->energy;
        // Bands below may still win something, but seldom more than this.
        constexpr double kHope = 4;
        band->trial_energy = band_energy(*band, band->trial, limit - others + (band->l > 2 ? kHope : 0));
        trial_energy_ = others + band->trial_energy;
        if (trial_energy_ == kNever) return kNever;
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

void TrackedInverses::accept() {
    for (Band& band : bands_) {
        if (band.is_changed) {
            band.a_hat.swap(band.trial);
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
    if (++accepted_since_refresh_ == kAcceptedBeforeRefresh) invert_afresh();
}

namespace {

/// A lobe to put at `position`.
Lobe draw_replacement(const CandidateGrid& grid, const LobeSet& lobes, int position, Random& random) {
    const Lobe old = lobes[position];
    const Lobe other = lobes[random.below(static_cast<int>(lobes.size()))];
    switch (random.below(8)) {
        case 0:
            return grid.random(random);
        case 1:
            return grid.random_on_great_circle(random);
        case 2:
            return grid.canonical(old.theta, random.below(static_cast<int>(grid.phis().size())));
        case 3:
            return grid.canonical(random.below(static_cast<int>(grid.thetas().size())), old.phi);
        case 4:
            return grid.canonical(other.theta, old.phi);
        case 5:
            return grid.canonical(old.theta, other.phi);
        case 6:
            return grid.random_image(old, random);
        default:
            return grid.random_image(other, random);
    }
}

}  // namespace

LobeSet anneal_by_swaps(const Problem& problem, const CandidateGrid& grid, const Objective& objective,
                        const Annealing& settings, const LobeSet& lobes, Random& random) {
    TrackedInverses state(problem, grid, objective, settings.norm_weight);
    if (!state.reset(lobes)) return lobes;
    LobeSet best = lobes;
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
            energy =
                state.try_replace(position, draw_replacement(grid, state.lobes(), position, random), limit);
        }
        if (!(energy <= limit)) continue;
        state.accept();
        if (state.energy() < best_energy - 1e-9) {
            best_energy = state.energy();
            best = state.lobes();
        }
    }
    return best;
}

}  // namespace zonal::search
