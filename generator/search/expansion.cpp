// Weights and lobes of one band at once, as the paper first finds them: NLopt's LBFGS minimises eq. 8 over
// weights and unconstrained angles with exact gradients, from a random start, and from another when it
// stalls. With E = A D Y - I: d|E|^2/dA = 2 n* E Y^T and d|E|^2/dY = 2 n* A^T E. Source: Nowrouzezahrai et
// al., section 4, eqs. 4, 7 and 8. Known limit: the lobes it ends with are dense and may be ill-conditioned;
// `search` is what finds sparse ones.

#include "search/expansion.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <nlopt.hpp>
#include <stdexcept>

#include "search/angle_model.hpp"
#include "search/random.hpp"

namespace zonal::search {
namespace {

using exact::Matrix;

constexpr int kStarts = 100;
constexpr int kEvaluationsOfARun = 20000;
constexpr int kStoredSteps = 100;  // fewer cost evaluations, more cost time

/// A run that lowers the residual by less has stalled.
constexpr double kProgress = 0.1;

std::vector<double> random_start(const ExpansionResidual& residual, int l, Random& random) {
    std::vector<double> x;
    for (int i = 0; i < 2 * l * (2 * l + 1); ++i) x.push_back(2 * random.uniform() - 1);
    while (static_cast<int>(x.size()) < residual.unknowns()) {
        x.push_back(std::acos(2 * random.uniform() - 1));
        x.push_back(2 * M_PI * random.uniform());
    }
    return x;
}

/// The way down from one start.
class Descent {
  public:
    Descent(const ExpansionResidual& residual, const std::vector<double>& start)
        : residual_(residual), best_(start) {
        std::vector<double> no_gradient;
        least_ = residual(start, no_gradient);
    }

    /// NLopt's LBFGS stops where the gradient is below 1e-8, and that cannot be set. So it runs again from
    /// where it stopped, x = origin + scale u, and sees residual / scale^2 with scale^2 the residual it
    /// begins with: value and curvature by u are about 1 in every run.
    void run() {
        double before = 0;
        do {
            before = least_;
            minimise();
        } while (least_ < kProgress * before);
    }

    const std::vector<double>& best() const { return best_; }
    double least() const { return least_; }
    int evaluations() const { return evaluations_; }

  private:
    void minimise() {
        origin_ = best_;
        scale_ = std::sqrt(least_);
        nlopt::opt optimiser(nlopt::LD_LBFGS, static_cast<unsigned>(origin_.size()));
        optimiser.set_min_objective(
            [](const std::vector<double>& u, std::vector<double>& gradient, void* descent) {
                return static_cast<Descent*>(descent)->evaluate(u, gradient);
            },
            this);
        optimiser.set_vector_storage(kStoredSteps);
        optimiser.set_maxeval(kEvaluationsOfARun);
        std::vector<double> u(origin_.size(), 0.0);
        double value = 0;
        try {
            optimiser.optimize(u, value);
        } catch (const std::runtime_error&) {
            // Roundoff or a line search without success, as wanted at the bottom: `least` tells.
        }
    }

    double evaluate(const std::vector<double>& u, std::vector<double>& gradient) {
        ++evaluations_;
        std::vector<double> x = origin_;
        for (std::size_t i = 0; i < x.size(); ++i) x[i] += scale_ * u[i];
        const double value = residual_(x, gradient);
        for (double& slope : gradient) slope /= scale_;
        if (value < least_) {
            least_ = value;
            best_ = x;
        }
        return value / (scale_ * scale_);
    }

    const ExpansionResidual& residual_;
    std::vector<double> best_, origin_;
    double least_ = 0, scale_ = 1;
    int evaluations_ = 0;
};

}  // namespace

double ExpansionResidual::operator()(const std::vector<double>& x, std::vector<double>& gradient) const {
    const Matrix<double> a = weights(x);
    const std::vector<double> lobes = angles(x);
    Matrix<double> y(size(), size()), by_theta(size(), size()), by_phi(size(), size());
    for (int d = 0; d < size(); ++d) {
        const BandDerivatives row = differentiate_band(l_, lobes[2 * d], lobes[2 * d + 1]);
        y.row(d) = row.values;
        by_theta.row(d) = row.by_theta;
        by_phi.row(d) = row.by_phi;
    }
    const double n = std::sqrt(4 * M_PI / size());
    const Matrix<double> error = n * a * y - Matrix<double>::Identity(size(), size());
    if (!gradient.empty()) {
        const Matrix<double> by_a = 2 * n * error * y.transpose();
        const Matrix<double> by_y = 2 * n * a.transpose() * error;
        auto slope = gradient.begin();
        for (int row = 0; row < size(); ++row)
            for (int d = 0; row != l_ && d < size(); ++d) *slope++ = by_a(row, d);
        for (int d = 0; d < size(); ++d) {
            if (d == l_) continue;
            *slope++ = by_y.row(d).dot(by_theta.row(d));
            *slope++ = by_y.row(d).dot(by_phi.row(d));
        }
    }
    return error.squaredNorm();
}

Matrix<double> ExpansionResidual::weights(const std::vector<double>& x) const {
    Matrix<double> a = Matrix<double>::Zero(size(), size());
    a(l_, l_) = 1;
    auto weight = x.begin();
    for (int row = 0; row < size(); ++row)
        for (int d = 0; row != l_ && d < size(); ++d) a(row, d) = *weight++;
    return a;
}

std::vector<double> ExpansionResidual::angles(const std::vector<double>& x) const {
    std::vector<double> angles(x.begin() + 2 * l_ * size(), x.end());
    angles.insert(angles.begin() + 2 * l_, {0, 0});  // the pole amid the others
    return angles;
}

double expansion_rounding(int l, const Matrix<double>& weights) {
    const double size = 2 * l + 1;
    const double norm =
        (size + M_PI * l) * std::sqrt(size) * std::numeric_limits<double>::epsilon() * weights.norm();
    return norm * norm;
}

Expansion solve_expansion(int l, std::uint64_t seed) {
    const auto began = std::chrono::steady_clock::now();
    const ExpansionResidual residual(l);
    Expansion expansion;
    while (expansion.starts < kStarts) {
        Random random(seed, expansion.starts++);
        Descent descent(residual, random_start(residual, l, random));
        descent.run();
        expansion.evaluations += descent.evaluations();
        expansion.weights = residual.weights(descent.best());
        if (!(descent.least() < expansion_rounding(l, expansion.weights))) continue;
        expansion.angles = residual.angles(descent.best());
        expansion.residual = descent.least();
        expansion.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
        return expansion;
    }
    throw std::runtime_error(
        fmt::format("eq. 8 of band {}: {} starts of seed {} stalled; take another seed", l, kStarts, seed));
}

}  // namespace zonal::search
