#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "search/angle_model.hpp"
#include "search/angled_lobe.hpp"
#include "search/random.hpp"
#include "search/score.hpp"

namespace zonal::search {

/// Local search among lobes anywhere on the sphere, in double, by ruin and recreate (Schrimpf et al., 2000).
/// A move gives up some zeros of Â, which frees angles; then it makes one nonzero after another zero, as long
/// as the zeros that are left leave freedom, by Levenberg and Marquardt's method on the angles. The cheapest
/// place on that way is taken or not by Metropolis's rule. Lobes can come to the pole, and stay there.
class AngleWalk {
  public:
    /// A regular set, by its angles (theta_0, phi_0, theta_1, …), with its zeros.
    struct Place {
        std::vector<double> angles;
        Pattern zeros;
        double cost = std::numeric_limits<double>::infinity();  ///< as `Score::cost`, in double
    };

    /// `temperature` in units of the cost.
    AngleWalk(const Problem& problem, const Objective& objective, double temperature, Random random)
        : problem_(&problem),
          objective_(objective),
          temperature_(temperature),
          random_(random),
          model_(problem) {}

    /// Begins at these lobes, or returns to them. Precondition: no band is singular.
    void start_from(const AngledSet& lobes);

    void move();

    /// The place of least cost since `start_from`.
    const Place& best() const { return best_; }

    /// Times the bands were inverted.
    std::int64_t evaluations() const { return evaluations_; }

  private:
    /// What a pattern leaves free, to first order.
    struct Freedom {
        exact::Matrix<double> directions;  ///< of the angles, orthonormal columns
        Pattern independent;               ///< relations of the pattern that imply the others

        bool is_any() const { return directions.cols() > 0; }
    };

    bool go_to(std::vector<double> angles);
    Place here() const;
    double cost(const std::vector<exact::Matrix<double>>& a_hats) const;
    Freedom freedom_of(const Pattern& pattern) const;
    Pattern without_some(const Pattern& zeros);
    std::optional<Relation> draw_target(const exact::Matrix<double>& freedom);
    bool make_zero(const Pattern& pattern);
    bool gain_a_zero(const Pattern& kept, const Freedom& freedom);

    const Problem* problem_;
    Objective objective_;
    double temperature_;
    Random random_;
    AngleModel model_;
    std::vector<double> angles_;  ///< where the model was evaluated
    Place current_, best_;
    std::int64_t evaluations_ = 0;
};

}  // namespace zonal::search
