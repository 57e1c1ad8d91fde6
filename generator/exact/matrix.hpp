#pragma once

#include <Eigen/Core>
#include <optional>

#include "exact/real.hpp"

/// Numbers of 50 digits as elements of Eigen's matrices.
template <>
struct Eigen::NumTraits<zonal::exact::Real> {
    using Real = zonal::exact::Real;
    using NonInteger = Real;
    using Literal = Real;
    using Nested = Real;
    enum {
        IsComplex = 0,
        IsInteger = 0,
        IsSigned = 1,
        RequireInitialization = 1,
        ReadCost = 1,
        AddCost = 4,
        MulCost = 8
    };
    static const Real& epsilon() {
        static const Real value = ldexp(Real(1), -167);
        return value;
    }
    static Real dummy_precision() { return 1000 * epsilon(); }
    static int digits10() { return 50; }
};

namespace zonal::exact {

template <class S>
using Direction = Eigen::Matrix<S, 3, 1>;
template <class S>
using Vector = Eigen::Matrix<S, Eigen::Dynamic, 1>;
template <class S>
using Matrix = Eigen::Matrix<S, Eigen::Dynamic, Eigen::Dynamic>;

/// Makes entries below `kZeroThreshold` exact zeros; returns how many are zero.
int set_small_to_zero(Matrix<Real>& matrix);

/// Y^-1 by full pivots; none where Y is singular at 50 digits.
std::optional<Matrix<Real>> inverse(const Matrix<Real>& y);

/// Descending.
Vector<double> singular_values(const Matrix<double>& matrix);

}  // namespace zonal::exact
