#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <limits>

namespace zonal {

/// A 3x3 rotation or mirror as the kernels read it: nine values, row-major, acting on column vectors.
/// It turns the function, not the frame: f'(w) = f(R^T w), so R ex = ey turns f = x into f' = y.
/// Eigen stores column-major unless told otherwise, so `m.data()` of an Eigen::Matrix3f is R^T;
/// constructing a RotationMatrix from `m` keeps the meaning of m(row, column).
/// Precondition: orthonormal rows; not enforced here (see checked_rotation), for a matrix of rounded values
/// never is orthonormal exactly. Determinant -1 (a mirror) is allowed.
template <class T>
class RotationMatrix {
  public:
    using Matrix = Eigen::Matrix<T, 3, 3, Eigen::RowMajor>;

    /// The identity.
    RotationMatrix() : matrix_(Matrix::Identity()) {}

    /// From any Eigen expression that is 3x3 at compile time; values are rounded to T.
    template <class Derived>
    explicit RotationMatrix(const Eigen::MatrixBase<Derived>& matrix) : matrix_(matrix.template cast<T>()) {
        static_assert(Derived::RowsAtCompileTime == 3 && Derived::ColsAtCompileTime == 3,
                      "a rotation is made from a 3x3 matrix whose size is known at compile time");
    }

    /// From Eigen::Quaternion (precondition: of unit norm) or Eigen::AngleAxis (precondition: unit axis).
    template <class Derived>
    explicit RotationMatrix(const Eigen::RotationBase<Derived, 3>& rotation)
        : RotationMatrix(rotation.toRotationMatrix()) {}

    const T* data() const { return matrix_.data(); }
    const Matrix& matrix() const { return matrix_; }

  private:
    Matrix matrix_;
};

/// ||R R^T - I||_F, computed in double. NaN when a value of R is NaN or infinite.
/// A kernel's error grows by at most its published excess times this number: (N-1)/2, or little more, but for
/// 2.3 of the contractions of orders 3 and 4.
template <class T>
double orthonormality_error(const RotationMatrix<T>& rotation) {
    const Eigen::Matrix3d r = rotation.matrix().template cast<double>();
    return r.allFinite() ? (r * r.transpose() - Eigen::Matrix3d::Identity()).norm()
                         : std::numeric_limits<double>::quiet_NaN();
}

/// True when det R < 0: R turns a right hand into a left hand.
template <class T>
bool is_mirror(const RotationMatrix<T>& rotation) {
    return rotation.matrix().template cast<double>().determinant() < 0;
}

namespace detail {
[[noreturn]] void throw_not_orthonormal(double error, double tolerance);
[[noreturn]] void throw_not_finite(int row, int column, double value);
}  // namespace detail

/// The checked entry: returns `rotation` unchanged when it is finite and orthonormal within `tolerance`.
/// A matrix rounded from an exact rotation has an orthonormality error below 2 epsilons of T
/// (2 ||dR||_F <= epsilon ||R||_F = sqrt(3) epsilon), so 1e-6 for float and 1e-14 for double leave some room.
/// Errors: zonal::Error names the first value that is not finite, or the error measured.
template <class T>
RotationMatrix<T> checked_rotation(const RotationMatrix<T>& rotation, double tolerance) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            const double value = static_cast<double>(rotation.matrix()(row, column));
            if (!std::isfinite(value)) detail::throw_not_finite(row, column, value);
        }
    }
    const double error = orthonormality_error(rotation);
    if (!(error <= tolerance)) detail::throw_not_orthonormal(error, tolerance);
    return rotation;
}

}  // namespace zonal
