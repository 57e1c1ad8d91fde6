#include "exact/factorization.hpp"

#include <limits>

#include "exact/spherical_harmonics.hpp"

namespace zonal::exact {

BandFactorization factorize_band(int l, const std::vector<Direction<Real>>& directions) {
    BandFactorization result;
    result.band = l;
    const Matrix<Real> y = band_matrix<Real>(l, lobes_of_band(l, directions));
    const Eigen::FullPivLU<Matrix<Real>> lu(y);
    // A double has room for conditions up to 1e16; what is worse is singular for every purpose here.
    const Eigen::JacobiSVD<Matrix<double>> svd(y.cast<double>());
    const auto& singular_values = svd.singularValues();
    const double smallest = singular_values(singular_values.size() - 1);
    result.condition = smallest > 1e-13 * singular_values(0) ? singular_values(0) / smallest
                                                             : std::numeric_limits<double>::infinity();
    if (!std::isfinite(result.condition)) return result;
    result.a_hat = lu.inverse();
    result.zeros = set_small_to_zero(result.a_hat);
    return result;
}

}  // namespace zonal::exact
