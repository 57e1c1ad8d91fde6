#pragma once

#include <Eigen/Dense>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/eigen.hpp>

namespace zonal::exact {

/// 50 decimal digits: what decides which factorization entries are zero, and what every emitted constant is
/// rounded from.
using Real = boost::multiprecision::cpp_bin_float_50;

/// An entry of a factorization smaller than this is zero (design section 4.1). Inverting a band of condition
/// 50 at 50 digits leaves about 1e-46, so the margin on both sides is wide.
inline const Real kZeroThreshold{"1e-30"};

template <class S>
using Direction = Eigen::Matrix<S, 3, 1>;
template <class S>
using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
template <class S>
using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

/// Makes entries below `kZeroThreshold` exact zeros; returns how many are zero.
inline int set_small_to_zero(Matrix<Real>& matrix) {
    int zeros = 0;
    for (Real& entry : matrix.reshaped())
        if (abs(entry) < kZeroThreshold) {
            entry = 0;
            ++zeros;
        }
    return zeros;
}

}  // namespace zonal::exact
