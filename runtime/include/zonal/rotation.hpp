#pragma once

#include <span>

#include "zonal/api.hpp"
#include "zonal/finite.hpp"

namespace zonal {
namespace detail {

/// How a library's rotations become nine values: zonal/eigen.hpp has it for Eigen's.
/// write(source, nine) writes them row-major, each rounded once to the type of `nine`.
template <class Source>
struct RotationConversion;

template <class Source, class T>
concept RotationSource = requires(const Source& source, T* nine) {
    RotationConversion<Source>::write(source, nine);
};

}  // namespace detail

/// A 3x3 rotation or mirror as the kernels read it: nine values, row-major, acting on column vectors.
/// It rotates the function, not the frame: f'(w) = f(R^T w), so R ex = ey makes f' = y of f = x.
/// Precondition: orthonormal rows; not enforced here (see checked_rotation), for a matrix of rounded values
/// never is orthonormal exactly. Determinant -1 (a mirror) is allowed.
/// T is float or double.
template <class T>
class RotationMatrix {
  public:
    /// The identity.
    constexpr RotationMatrix() = default;

    /// From nine values, row by row: rXY is in row x, column y; so (rxx, ryx, rzx) is where the x axis goes.
    constexpr RotationMatrix(T rxx, T rxy, T rxz, T ryx, T ryy, T ryz, T rzx, T rzy, T rzz)
        : values_{rxx, rxy, rxz, ryx, ryy, ryz, rzx, rzy, rzz} {}

    /// From nine values, row-major: a std::array, an array or a span of fixed length. A matrix that is stored
    /// column-major (glm, OpenGL, Eigen's default) would be R^T, the inverse.
    constexpr explicit RotationMatrix(std::span<const T, 9> row_major)
        : RotationMatrix(from_row_major(row_major.data())) {}

    /// The same from a pointer to nine values.
    static constexpr RotationMatrix from_row_major(const T* r) {
        return {r[0], r[1], r[2], r[3], r[4], r[5], r[6], r[7], r[8]};
    }

    /// From a quaternion w + x i + y j + z k; q and -q are the same rotation.
    /// Precondition: of unit norm within what the caller can bear, not checked. A norm of 1 + e gives
    /// R R^T - I = 2e (2 I - R - R^T) to first order: an orthonormality error of at most 8 sqrt(2) |e|.
    static constexpr RotationMatrix from_quaternion_wxyz(T w, T x, T y, T z) {
        const T tx = 2 * x, ty = 2 * y, tz = 2 * z;
        return {1 - (ty * y + tz * z), tx * y - tz * w,       tx * z + ty * w,
                tx * y + tz * w,       1 - (tx * x + tz * z), ty * z - tx * w,
                tx * z - ty * w,       ty * z + tx * w,       1 - (tx * x + ty * y)};
    }
    /// The same, the real part last, as Eigen, glTF and most engines store it.
    static constexpr RotationMatrix from_quaternion_xyzw(T x, T y, T z, T w) {
        return from_quaternion_wxyz(w, x, y, z);
    }

    /// From what another library has: with zonal/eigen.hpp included, any Eigen expression that is 3x3 at
    /// compile time, Eigen::Quaternion (precondition: of unit norm) and Eigen::AngleAxis (precondition: unit
    /// axis). Values are rounded to T; the meaning of m(row, column) is kept, however the matrix is stored.
    template <class Source>
    requires detail::RotationSource<Source, T>
    explicit RotationMatrix(const Source& source) {
        detail::RotationConversion<Source>::write(source, values_);
    }

    /// Nine values, row-major.
    constexpr const T* data() const { return values_; }
    /// The value in a row and column, each 0 to 2.
    constexpr T operator()(int row, int column) const { return values_[3 * row + column]; }

    /// Each value rounded to U.
    template <class U>
    constexpr RotationMatrix<U> cast() const {
        RotationMatrix<U> result;
        for (int i = 0; i < 9; ++i) result.values_[i] = static_cast<U>(values_[i]);
        return result;
    }

    /// As a row-major 3x3 matrix of Eigen. Needs zonal/eigen.hpp.
    template <class Self = RotationMatrix>
    auto matrix() const {
        return to_eigen(static_cast<const Self&>(*this));
    }

    friend constexpr bool operator==(const RotationMatrix&, const RotationMatrix&) = default;

  private:
    template <class U>
    friend class RotationMatrix;

    T values_[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
};

/// ||R R^T - I||_F, computed in double. NaN when a value of R is NaN or infinite.
/// A kernel's error grows by at most its published excess times this number: (N-1)/2, or little more, but for
/// 2.3 of the contractions of orders 3 and 4.
ZONAL_API double orthonormality_error(const RotationMatrix<double>& rotation);
inline double orthonormality_error(const RotationMatrix<float>& rotation) {
    return orthonormality_error(rotation.cast<double>());
}

/// True when det R < 0: R makes a left hand of a right hand.
template <class T>
constexpr bool is_mirror(const RotationMatrix<T>& rotation) {
    const RotationMatrix<double> r = rotation.template cast<double>();
    const double determinant = r(0, 0) * (r(1, 1) * r(2, 2) - r(1, 2) * r(2, 1)) -
                               r(0, 1) * (r(1, 0) * r(2, 2) - r(1, 2) * r(2, 0)) +
                               r(0, 2) * (r(1, 0) * r(2, 1) - r(1, 1) * r(2, 0));
    return determinant < 0;
}

namespace detail {
[[noreturn]] ZONAL_API void throw_not_orthonormal(double error, double tolerance);
[[noreturn]] ZONAL_API void throw_not_finite(int row, int column, double value);
}  // namespace detail

/// The checked entry: returns `rotation` unchanged when it is finite and orthonormal within `tolerance`.
/// A matrix rounded from an exact rotation has an orthonormality error below 2 epsilons of T
/// (2 ||dR||_F <= epsilon ||R||_F = sqrt(3) epsilon), so 1e-6 for float and 1e-14 for double leave some room.
/// Errors: zonal::Error names the first value that is not finite, or the error measured. A tolerance that is
/// NaN accepts nothing. The tests are of bits, so they stay where the caller is compiled with -ffast-math.
template <class T>
RotationMatrix<T> checked_rotation(const RotationMatrix<T>& rotation, double tolerance) {
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            const T value = rotation(row, column);
            if (!detail::is_finite(value)) detail::throw_not_finite(row, column, static_cast<double>(value));
        }
    }
    const double error = orthonormality_error(rotation);
    if (detail::is_nan(tolerance) || !(error <= tolerance)) detail::throw_not_orthonormal(error, tolerance);
    return rotation;
}

}  // namespace zonal
