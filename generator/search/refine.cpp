// Refinement off the grid. The zero pattern of a good set can leave continuous freedom; along it another
// entry may reach zero, or the condition may fall. NLopt's LBFGS minimises over the angles
//   sum of (zeros to keep)^2 + target^2          to gain a zero,
//   weight * sum of (relations to keep)^2 + sum of log2 ||Â_l||_F          to lower the condition,
// with exact gradients; `polish` then confirms the pattern at 50 digits or throws it out. Lobes at the pole
// stay there, and an angle that was not moved keeps its closed form.

#include "search/refine.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <nlopt.hpp>
#include <numeric>

#include "search/angle_model.hpp"
#include "search/pattern.hpp"
#include "search/polish.hpp"

namespace zonal::search {
namespace {

using exact::Real;

/// How many of the smallest entries are tried as further zeros.
constexpr int kMostTargets = 24;

class Refiner {
  public:
    Refiner(const Problem& problem, const Objective& objective, const Solution& start)
        : problem_(problem), objective_(objective), model_(problem), best_(start) {
        adopt(start);
    }

    /// Tries the entries one after another, nearest to zero first; true as soon as one is gained.
    bool gain_a_zero(const std::function<bool()>& is_stopped) {
        const Pattern zeros = zeros_of(a_hats_);
        if (!has_freedom(zeros)) return false;
        for (const Relation& target : targets()) {
            if (is_stopped()) return false;
            Pattern pattern = zeros;
            pattern.push_back(target);
            const auto moved = minimise(pattern, 1, 0);
            if (moved && accept(*moved, pattern)) return true;
        }
        return false;
    }

    /// Spends freedom on the condition; true when that was worth something.
    bool lower_condition() {
        Pattern pattern = zeros_of(a_hats_);
        const Pattern equalities = equalities_of(a_hats_);
        pattern.insert(pattern.end(), equalities.begin(), equalities.end());
        if (!has_freedom(pattern)) return false;
        const auto moved = minimise(pattern, 1e4, 1);
        return moved && accept(*moved, pattern);
    }

    const Solution& best() const { return best_; }

  private:
    void adopt(const Solution& solution) {
        best_ = solution;
        angles_ = angles_in_double(solution.lobes);
        if (model_.evaluate(angles_)) a_hats_ = model_.a_hats();
    }

    /// Neither angle of a lobe at the pole is a coordinate there.
    bool is_movable(int angle) const { return !is_at_pole(angles_[angle - angle % 2]); }

    /// Whether angles can move, to first order, with the pattern unbroken.
    bool has_freedom(const Pattern& pattern) {
        model_.evaluate(angles_);
        int movable = 0;
        for (int i = 0; i < static_cast<int>(angles_.size()); ++i) movable += is_movable(i);
        Eigen::ColPivHouseholderQR<exact::Matrix<double>> decomposition;
        decomposition.setThreshold(1e-7);
        decomposition.compute(model_.jacobian(pattern));
        return decomposition.rank() < movable;
    }

    /// The smallest entries of bands >= 2 that are not zero, smallest first.
    Pattern targets() const {
        Pattern targets = nonzeros_of(problem_, a_hats_);
        std::ranges::stable_sort(targets, {}, [&](const Relation& target) {
            return std::abs(target.residual(a_hats_[target.band_index]));
        });
        if (targets.size() > kMostTargets) targets.resize(kMostTargets);
        return targets;
    }

    /// Angles that minimise pattern_weight * (sum of squared residuals) + norm_weight * (sum of log norms),
    /// from the present ones.
    std::optional<std::vector<double>> minimise(const Pattern& pattern, double pattern_weight,
                                                double norm_weight) {
        const auto value_and_gradient = [&](const std::vector<double>& angles,
                                            std::vector<double>& gradient) {
            std::vector<double> slope(angles.size(), 0.0);
            double value = 0;
            if (!model_.evaluate(angles)) {
                value = 1e30;  // a wall
            } else {
                for (const Relation& relation : pattern) {
                    const double residual = model_.residual(relation);
                    value += pattern_weight * residual * residual;
                    const exact::Vector<double> by_angle = model_.residual_gradient(relation);
                    const double factor = 2 * pattern_weight * residual;
                    for (std::size_t i = 0; i < slope.size(); ++i) slope[i] += factor * by_angle(i);
                }
                if (norm_weight > 0) value += norm_weight * model_.log_norm(norm_weight, slope.data());
            }
            if (!gradient.empty()) {
                for (int i = 0; i < static_cast<int>(slope.size()); ++i)
                    gradient[i] = is_movable(i) ? slope[i] : 0;
            }
            return value;
        };
        using Function = decltype(value_and_gradient);
        nlopt::opt optimiser(nlopt::LD_LBFGS, static_cast<unsigned>(angles_.size()));
        optimiser.set_min_objective(
            [](const std::vector<double>& x, std::vector<double>& gradient, void* function) {
                return (*static_cast<Function*>(function))(x, gradient);
            },
            const_cast<void*>(static_cast<const void*>(&value_and_gradient)));
        optimiser.set_maxeval(300);
        optimiser.set_xtol_rel(1e-12);
        if (norm_weight == 0) optimiser.set_stopval(1e-18);
        std::vector<double> angles = angles_;
        double value = 0;
        try {
            optimiser.optimize(angles, value);
        } catch (const nlopt::roundoff_limited&) {
            // As good as double gets: the last angles stand.
        } catch (const std::runtime_error&) {
            return std::nullopt;
        }
        if (norm_weight == 0 && value > 1e-10) return std::nullopt;
        return angles;
    }

    /// Polishes, scores at 50 digits, and keeps what lowers the cost.
    bool accept(const std::vector<double>& angles, const Pattern& pattern) {
        const auto polished = polish_moved(problem_, best_.lobes, angles, pattern);
        if (!polished) return false;
        const Solution refined = confirm(problem_, *polished);
        const double gain = best_.score.cost(objective_) - refined.score.cost(objective_);
        if (!(gain > kWorthwhile)) return false;
        adopt(refined);
        return true;
    }

    const Problem& problem_;
    const Objective& objective_;
    AngleModel model_;
    Solution best_;
    std::vector<double> angles_;
    std::vector<exact::Matrix<double>> a_hats_;
};

}  // namespace

Solution confirm(const Problem& problem, const AngledSet& lobes) {
    return {lobes, exact_score(problem, directions_of(lobes))};
}

Solution refine(const Problem& problem, const Objective& objective, const Solution& start,
                const std::function<bool()>& is_stopped) {
    if (start.score.is_singular()) return start;
    Refiner refiner(problem, objective, start);
    while (!is_stopped() && refiner.gain_a_zero(is_stopped)) {
    }
    if (!is_stopped()) refiner.lower_condition();
    return refiner.best();
}

}  // namespace zonal::search
