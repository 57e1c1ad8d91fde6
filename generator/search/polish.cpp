// Minimum-norm Gauss-Newton on the angles. Residuals are taken at 50 digits, the Jacobian in double: a step
// then still gains some ten digits, and costs no 50-digit decomposition.

#include "search/polish.hpp"

#include "exact/spherical_harmonics.hpp"
#include "search/angle_model.hpp"

namespace zonal::search {
namespace {

using exact::Real;

const Real kPolished{"1e-45"};
constexpr int kSteps = 20;

/// Empty when a band is singular.
std::vector<Real> residuals_of(const Problem& problem, const AngledSet& lobes, const Pattern& pattern) {
    const auto directions = directions_of(lobes);
    std::vector<exact::Matrix<Real>> a_hats;
    for (const int l : problem.bands) {
        const Eigen::FullPivLU<exact::Matrix<Real>> lu(
            exact::band_matrix<Real>(l, exact::lobes_of_band(l, directions)));
        if (!lu.isInvertible()) return {};
        a_hats.push_back(lu.inverse());
    }
    std::vector<Real> residuals;
    for (const Relation& relation : pattern)
        residuals.push_back(relation.residual(a_hats[relation.band_index]));
    return residuals;
}

Real largest_of(const std::vector<Real>& residuals) {
    Real largest = 0;
    for (const Real& residual : residuals) {
        if (abs(residual) > largest) largest = abs(residual);
    }
    return largest;
}

std::vector<double> angles_in_double(const AngledSet& lobes) {
    std::vector<double> angles;
    for (const AngledLobe& lobe : lobes) {
        angles.push_back(static_cast<double>(lobe.theta.value));
        angles.push_back(static_cast<double>(lobe.phi.value));
    }
    return angles;
}

}  // namespace

Real largest_residual(const Problem& problem, const AngledSet& lobes, const Pattern& pattern) {
    return largest_of(residuals_of(problem, lobes, pattern));
}

std::optional<AngledSet> polish(const Problem& problem, const AngledSet& lobes, const Pattern& pattern,
                                const std::vector<bool>& is_free) {
    std::vector<int> free_angles;
    for (std::size_t i = 0; i < is_free.size(); ++i) {
        if (is_free[i]) free_angles.push_back(static_cast<int>(i));
    }
    AngledSet polished = lobes;
    AngleModel model(problem);
    for (int step = 0; step < kSteps; ++step) {
        const std::vector<Real> residuals = residuals_of(problem, polished, pattern);
        if (residuals.size() != pattern.size()) return std::nullopt;
        if (largest_of(residuals) < kPolished) return polished;
        if (free_angles.empty() || !model.evaluate(angles_in_double(polished))) return std::nullopt;

        exact::Matrix<double> jacobian(pattern.size(), free_angles.size());
        exact::Vector<double> right(pattern.size());
        for (std::size_t r = 0; r < pattern.size(); ++r) {
            right(r) = static_cast<double>(residuals[r]);
            const exact::Vector<double> gradient = model.residual_gradient(pattern[r]);
            for (std::size_t i = 0; i < free_angles.size(); ++i) jacobian(r, i) = gradient(free_angles[i]);
        }
        Eigen::CompleteOrthogonalDecomposition<exact::Matrix<double>> decomposition;
        decomposition.setThreshold(1e-9);
        decomposition.compute(jacobian);
        const exact::Vector<double> change = decomposition.solve(right);
        for (std::size_t i = 0; i < free_angles.size(); ++i) {
            if (change(i) == 0) continue;
            AngledLobe& lobe = polished[free_angles[i] / 2];
            Angle& angle = free_angles[i] % 2 == 0 ? lobe.theta : lobe.phi;
            angle.value -= change(i);
            angle.text = exact::decimal_text(angle.value);
        }
    }
    return std::nullopt;
}

}  // namespace zonal::search
