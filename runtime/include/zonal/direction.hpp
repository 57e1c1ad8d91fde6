#pragma once

namespace zonal {
namespace detail {

/// How a library's vectors of three become directions and back: zonal/eigen.hpp has it for Eigen's.
template <class Vector>
struct DirectionConversion;

}  // namespace detail

/// A direction (dimensionless, z polar); a unit vector wherever nothing else is said, not checked.
/// With zonal/eigen.hpp included, vectors of Eigen convert to it and, by assignment, from it.
struct Direction {
    double x = 0;
    double y = 0;
    double z = 0;

    constexpr Direction() = default;
    constexpr Direction(double x_, double y_, double z_) : x(x_), y(y_), z(z_) {}

    template <class Vector>
    requires requires(const Vector& vector) { detail::DirectionConversion<Vector>::from(vector); }
    Direction(const Vector& vector) : Direction(detail::DirectionConversion<Vector>::from(vector)) {}

    template <class Vector>
    requires requires(const Direction& direction) { detail::DirectionConversion<Vector>::to(direction); }
    operator Vector() const { return detail::DirectionConversion<Vector>::to(*this); }

    friend constexpr bool operator==(const Direction&, const Direction&) = default;
};

}  // namespace zonal
