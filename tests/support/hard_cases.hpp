#pragma once

#include <array>
#include <random>
#include <string>
#include <vector>

namespace zonal::cases {

/// A rotation as a kernel is given it, row-major, in double (a float kernel gets it rounded).
using Matrix = std::array<double, 9>;

struct Case {
    std::string name;
    Matrix rotation;
};

Matrix product(const Matrix& a, const Matrix& b);
Matrix transposed(const Matrix& a);
/// Rotation by an angle about a unit axis.
Matrix about_axis(const std::array<double, 3>& axis, double angle_rad);
Matrix random_rotation(std::mt19937_64& random);
/// The same with every product rounded to T, as a program that composes matrices in T has them.
template <class T>
Matrix rounded_product(const Matrix& a, const Matrix& b);

/// Every entry with normal noise of a third of `noise`, which is so nearly its largest: orthonormal only to
/// `noise`.
Matrix with_noise(Matrix rotation, double noise, std::mt19937_64& random);

/// The rotations of design section 6: identity, half turns, axis permutations, mirrors, tilts from both
/// poles, products of T matrices that should be a pure z rotation (noise at the pole), and matrices
/// orthonormal only to 1e-3, 1e-5, 1e-7. `random` draws the axes and the noise.
template <class T>
std::vector<Case> hard_rotations(std::mt19937_64& random);

/// Tilts of 1e-25 … 1e-9 rad from both poles, two a decade, about the x axis and about random ones: squares
/// of their entries are no normal floats, and no normal doubles where they are flushed.
std::vector<Case> tiny_tilts(std::mt19937_64& random);

/// N² standard normal coefficients.
std::vector<double> random_signal(int order, std::mt19937_64& random);

/// Signals of design section 6 of sizes a type can hold: energy in one band only, all times 1e30 and 1e-30,
/// one band a million times the others, zeros.
std::vector<std::vector<double>> hard_signals(int order, std::mt19937_64& random);

}  // namespace zonal::cases
