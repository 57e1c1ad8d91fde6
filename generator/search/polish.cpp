// Minimum-norm Gauss-Newton on the angles. Residuals are taken at 50 digits, the Jacobian in double: a step
// then still gains some ten digits, and costs no 50-digit decomposition.

#include "search/polish.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>

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
        const auto a_hat = exact::inverse(exact::band_matrix<Real>(l, exact::lobes_of_band(l, directions)));
        if (!a_hat) return {};
        a_hats.push_back(*a_hat);
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

/// An angle that moved less than this has not moved.
constexpr double kStill = 1e-6;

/// theta in [0, pi/2], phi in [0, 2 pi), for the lobe or its antipode.
AngledLobe wrapped(AngledLobe lobe) {
    const Real& pi = exact::pi();
    const auto set = [](Angle& angle, const Real& value) {
        if (value == angle.value) return;
        angle.value = value;
        angle.text = exact::decimal_text(value);
    };
    const Real turns = floor(lobe.theta.value / (2 * pi));
    set(lobe.theta, lobe.theta.value - turns * 2 * pi);
    if (lobe.theta.value > pi) {
        set(lobe.theta, 2 * pi - lobe.theta.value);
        set(lobe.phi, lobe.phi.value + pi);
    }
    if (lobe.theta.value > pi / 2) {
        set(lobe.theta, pi - lobe.theta.value);
        set(lobe.phi, lobe.phi.value + pi);
    }
    set(lobe.phi, lobe.phi.value - floor(lobe.phi.value / (2 * pi)) * 2 * pi);
    // What polishing leaves of zero, from either side.
    const Real tiny{"1e-40"};
    if (lobe.phi.value < tiny || 2 * pi - lobe.phi.value < tiny) lobe.phi = {0, "0"};
    return lobe;
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

        const exact::Matrix<double> jacobian = model.jacobian(pattern)(Eigen::all, free_angles);
        exact::Vector<double> right(pattern.size());
        for (std::size_t r = 0; r < pattern.size(); ++r) right(r) = static_cast<double>(residuals[r]);
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

std::optional<AngledSet> polish_moved(const Problem& problem, const AngledSet& lobes,
                                      const std::vector<double>& angles, const Pattern& pattern) {
    const std::vector<double> angles_before = angles_in_double(lobes);
    AngledSet moved = lobes;
    std::vector<bool> is_free(angles.size(), false);
    for (std::size_t d = 0; d < moved.size(); ++d) {
        if (is_at_pole(angles[2 * d])) {
            if (!is_at_pole(angles_before[2 * d])) moved[d] = {{0, "0"}, {0, "0"}};
            continue;  // neither angle is a coordinate there
        }
        for (const std::size_t i : {2 * d, 2 * d + 1}) {
            if (std::abs(angles[i] - angles_before[i]) < kStill) continue;
            is_free[i] = true;
            Angle& angle = i % 2 == 0 ? moved[d].theta : moved[d].phi;
            angle = {angles[i], exact::decimal_text(angles[i])};
        }
    }
    auto polished = polish(problem, moved, pattern, is_free);
    if (polished) std::ranges::transform(*polished, polished->begin(), wrapped);
    return polished;
}

}  // namespace zonal::search
