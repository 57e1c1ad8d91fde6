#include "lobes/factorization.hpp"

#include <atomic>
#include <cmath>
#include <limits>

#include "exact/spherical_harmonics.hpp"

namespace zonal {
namespace {

using exact::Direction, exact::Matrix, exact::Real, exact::Vector;

std::atomic<int> factorized = 0;

}  // namespace

int factorized_bands() { return factorized; }

BandFactorization factorize_band(int l, const std::vector<Direction<Real>>& directions) {
    ++factorized;
    BandFactorization result;
    result.band = l;
    const Matrix<Real> y = exact::band_matrix<Real>(l, exact::lobes_of_band(l, directions));
    // A double has room for conditions up to 1e16; what is worse is singular for every purpose here.
    const Vector<double> singular_values = exact::singular_values(y.cast<double>());
    const double largest = singular_values(0), smallest = singular_values(singular_values.size() - 1);
    result.condition =
        smallest > 1e-13 * largest ? largest / smallest : std::numeric_limits<double>::infinity();
    if (!std::isfinite(result.condition)) return result;
    result.a_hat = exact::inverse(y).value();
    result.zeros = exact::set_small_to_zero(result.a_hat);
    return result;
}

}  // namespace zonal
