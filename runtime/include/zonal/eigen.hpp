#pragma once

// Eigen's matrices, quaternions, angle-axes and vectors where zonal takes rotations and directions. The only
// header of zonal::rotate and zonal::light that needs Eigen (3.4): link Eigen3::Eigen beside them.
//
//     const zonal::RotationMatrix<float> rotation(Eigen::AngleAxisf(angle_rad, axis));
//     zonal::evaluate_basis(order, Eigen::Vector3d(x, y, z), values);
//
// Eigen stores matrices column-major unless told otherwise, so m.data() of an Eigen::Matrix3f is R^T; these
// conversions keep the meaning of m(row, column).

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <concepts>

#include "zonal/direction.hpp"
#include "zonal/rotation.hpp"

namespace zonal {

/// Row-major, as zonal has it.
template <class T>
Eigen::Matrix<T, 3, 3, Eigen::RowMajor> to_eigen(const RotationMatrix<T>& rotation) {
    return Eigen::Map<const Eigen::Matrix<T, 3, 3, Eigen::RowMajor>>(rotation.data());
}

inline Eigen::Vector3d to_eigen(const Direction& direction) {
    return {direction.x, direction.y, direction.z};
}

namespace detail {

/// Any expression that is 3x3 at compile time.
template <class Matrix>
requires std::derived_from<Matrix, Eigen::MatrixBase<Matrix>>
struct RotationConversion<Matrix> {
    template <class T>
    static void write(const Matrix& matrix, T* nine) {
        static_assert(Matrix::RowsAtCompileTime == 3 && Matrix::ColsAtCompileTime == 3,
                      "a rotation is made from a 3x3 matrix whose size is known at compile time");
        Eigen::Map<Eigen::Matrix<T, 3, 3, Eigen::RowMajor>>{nine} = matrix.template cast<T>();
    }
};

/// Eigen::Quaternion and Eigen::AngleAxis.
template <class Rotation>
requires std::derived_from<Rotation, Eigen::RotationBase<Rotation, 3>>
struct RotationConversion<Rotation> {
    template <class T>
    static void write(const Rotation& rotation, T* nine) {
        Eigen::Map<Eigen::Matrix<T, 3, 3, Eigen::RowMajor>>{nine} =
            rotation.toRotationMatrix().template cast<T>();
    }
};

/// Any expression that is a vector of three at compile time.
template <class Vector>
requires std::derived_from<Vector, Eigen::MatrixBase<Vector>>
struct DirectionConversion<Vector> {
    static Direction from(const Vector& vector) requires(Vector::SizeAtCompileTime == 3) {
        const Eigen::Vector3d values = vector.template cast<double>();
        return {values.x(), values.y(), values.z()};
    }
    static Vector to(const Direction& direction) requires
        std::same_as<Vector, Eigen::Matrix<typename Vector::Scalar, 3, 1>> {
        return to_eigen(direction).cast<typename Vector::Scalar>();
    }
};

}  // namespace detail
}  // namespace zonal
