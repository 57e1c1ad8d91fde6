#include "exact/matrix.hpp"

#include <Eigen/LU>
#include <Eigen/SVD>

namespace zonal::exact {

int set_small_to_zero(Matrix<Real>& matrix) {
    int zeros = 0;
    for (Real& entry : matrix.reshaped())
        if (abs(entry) < kZeroThreshold) {
            entry = 0;
            ++zeros;
        }
    return zeros;
}

std::optional<Matrix<Real>> inverse(const Matrix<Real>& y) {
    const Eigen::FullPivLU<Matrix<Real>> lu(y);
    if (!lu.isInvertible()) return std::nullopt;
    return Matrix<Real>(lu.inverse());
}

Vector<double> singular_values(const Matrix<double>& matrix) {
    return Eigen::JacobiSVD<Matrix<double>>(matrix).singularValues();
}

}  // namespace zonal::exact
