#pragma once

#include <cmath>
#include <vector>

#include "exact/matrix.hpp"
#include "search/pattern.hpp"
#include "search/problem.hpp"

namespace zonal::search {

/// A lobe of this theta is at the pole, where neither angle is a coordinate.
inline bool is_at_pole(double theta) { return std::abs(theta) < 1e-9; }

/// The inverses of all bands as smooth functions of the lobes' angles (theta_0, phi_0, theta_1, phi_1, …),
/// with their derivatives, in double. With dY = e_d g^T, dÂ = -Â dY Â = -(column d of Â) (g^T Â).
class AngleModel {
  public:
    explicit AngleModel(const Problem& problem) : problem_(problem), bands_(problem.bands.size()) {}

    /// False when a band is singular: then nothing else may be asked.
    bool evaluate(const std::vector<double>& angles);

    std::vector<exact::Matrix<double>> a_hats() const;

    double residual(const Relation& relation) const {
        return relation.residual(bands_[relation.band_index].a_hat);
    }

    /// Derivative of a residual by every angle.
    exact::Vector<double> residual_gradient(const Relation& relation) const;

    /// The derivatives of all residuals of a pattern: a row for each relation, a column for each angle. Lobes
    /// at the pole stay there: their columns are zero.
    exact::Matrix<double> jacobian(const Pattern& pattern) const;

    /// Sum over the bands of log2(||Â_l||_F); adds `weight` times its gradient to `gradient`.
    double log_norm(double weight, double* gradient) const;

  private:
    struct Band {
        exact::Matrix<double> a_hat;
        exact::Matrix<double> by_theta, by_phi;  // row d: derivative of row d of Y
    };

    const Problem& problem_;
    std::vector<Band> bands_;
    std::vector<bool> is_lobe_at_pole_;
};

/// y_l^{-l} … y_l^l at two angles with their derivatives.
struct BandDerivatives {
    exact::Vector<double> values, by_theta, by_phi;
};
BandDerivatives differentiate_band(int l, double theta, double phi);

}  // namespace zonal::search
