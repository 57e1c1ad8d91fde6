#include "lobes/ring.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "exact/angles.hpp"
#include "exact/spherical_harmonics.hpp"

namespace zonal {
namespace {

using exact::Direction, exact::Matrix, exact::Real, exact::Vector;

/// cond_2(Y_l) on a ring: the functions of one |m| share the norm |profile_m| sqrt(count / 2), that of m = 0
/// is |profile_0| sqrt(count).
double condition_on_ring(int l, double theta) {
    const Vector<double> profile = exact::evaluate_band<double>(l, {std::sin(theta), 0.0, std::cos(theta)});
    double largest = 0, smallest = std::numeric_limits<double>::infinity();
    for (int m = 0; m <= l; ++m) {
        const double norm = std::abs(profile(l + m)) * (m == 0 ? std::sqrt(2.0) : 1.0);
        largest = std::max(largest, norm);
        smallest = std::min(smallest, norm);
    }
    return largest / smallest;
}

double worst_condition(int order, double theta) {
    double worst = 1;
    for (int l = 1; l < order; ++l) worst = std::max(worst, condition_on_ring(l, theta));
    return worst;
}

}  // namespace

std::vector<Direction<Real>> Ring::directions() const {
    std::vector<Direction<Real>> directions;
    for (int d = 0; d < count; ++d)
        directions.push_back(exact::direction_of(theta, 2 * exact::pi() * d / count));
    return directions;
}

BandFactorization Ring::factorize(int l) const {
    BandFactorization result;
    result.band = l;
    const std::vector<Direction<Real>> lobes = directions();
    const Matrix<Real> y = exact::band_matrix<Real>(l, lobes);
    const Vector<Real> squared_norms = y.colwise().squaredNorm();
    result.a_hat = squared_norms.cwiseInverse().asDiagonal() * y.transpose();
    result.zeros = exact::set_small_to_zero(result.a_hat);
    result.condition =
        std::sqrt(static_cast<double>(Real(squared_norms.maxCoeff() / squared_norms.minCoeff())));
    return result;
}

Ring best_ring(int order) {
    // Up to the equator, where the profiles with l + m odd vanish. Steps are coarse enough for every compiler
    // to agree on the best.
    constexpr int kSteps = 157;
    int best = 1;
    for (int step = 2; step <= kSteps; ++step)
        if (worst_condition(order, step / 100.0) < worst_condition(order, best / 100.0)) best = step;
    return {2 * order - 1, Real(best) / 100};
}

}  // namespace zonal
