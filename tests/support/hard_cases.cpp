#include "support/hard_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace zonal::cases {

namespace {

using Real = long double;
/// A matrix before it is rounded, once, to what a kernel is given.
using Exact = std::array<Real, 9>;

constexpr Real kPi = std::numbers::pi_v<Real>;

Matrix rounded(const Exact& matrix) {
    Matrix result{};
    for (int i = 0; i < 9; ++i) result[i] = static_cast<double>(matrix[i]);
    return result;
}

Exact product_of(const Exact& a, const Exact& b) {
    Exact result{};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k) result[3 * i + j] += a[3 * i + k] * b[3 * k + j];
    return result;
}

Exact turn(const std::array<Real, 3>& axis, Real angle_rad) {
    const Real c = std::cos(angle_rad), s = std::sin(angle_rad), t = 2 * std::pow(std::sin(angle_rad / 2), 2);
    const auto [x, y, z] = axis;
    return {c + t * x * x,     t * x * y - s * z, t * x * z + s * y, t * x * y + s * z, c + t * y * y,
            t * y * z - s * x, t * x * z - s * y, t * y * z + s * x, c + t * z * z};
}

std::array<Real, 3> random_axis(std::mt19937_64& random) {
    std::normal_distribution<Real> normal;
    std::array<Real, 3> axis{normal(random), normal(random), normal(random)};
    const Real norm = std::hypot(axis[0], axis[1], axis[2]);
    for (Real& component : axis) component /= norm;
    return axis;
}

Matrix scaled(Matrix matrix, double factor) {
    for (double& entry : matrix) entry *= factor;
    return matrix;
}

/// The 48 signed permutation matrices: 24 rotations and their mirrors.
std::vector<Case> signed_permutations() {
    std::vector<Case> cases;
    std::array<int, 3> axes{0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs) {
            Matrix matrix{};
            for (int i = 0; i < 3; ++i) matrix[3 * i + axes[i]] = (signs >> i & 1) != 0 ? -1 : 1;
            cases.push_back({"signed permutation of the axes", matrix});
        }
    } while (std::next_permutation(axes.begin(), axes.end()));
    return cases;
}

}  // namespace

Matrix product(const Matrix& a, const Matrix& b) { return rounded_product<double>(a, b); }

Matrix transposed(const Matrix& a) { return {a[0], a[3], a[6], a[1], a[4], a[7], a[2], a[5], a[8]}; }

Matrix about_axis(const std::array<double, 3>& axis, double angle_rad) {
    const std::array<Real, 3> exact{axis[0], axis[1], axis[2]};
    return rounded(turn(exact, angle_rad));
}

Matrix random_rotation(std::mt19937_64& random) {
    // A normally distributed quaternion is uniform over rotations.
    std::normal_distribution<Real> normal;
    Real q[4], norm = 0;
    for (Real& component : q) {
        component = normal(random);
        norm += component * component;
    }
    for (Real& component : q) component /= std::sqrt(norm);
    const auto [w, x, y, z] = q;
    return rounded({1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), 2 * (x * y + z * w),
                    1 - 2 * (x * x + z * z), 2 * (y * z - x * w), 2 * (x * z - y * w), 2 * (y * z + x * w),
                    1 - 2 * (x * x + y * y)});
}

template <class T>
Matrix rounded_product(const Matrix& a, const Matrix& b) {
    Matrix result{};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            T sum = 0;
            for (int k = 0; k < 3; ++k) {
                const T term = static_cast<T>(a[3 * i + k]) * static_cast<T>(b[3 * k + j]);
                sum += term;
            }
            result[3 * i + j] = sum;
        }
    }
    return result;
}

template <class T>
std::vector<Case> hard_rotations(std::mt19937_64& random) {
    std::uniform_real_distribution<Real> angle(-kPi, kPi);
    std::vector<Case> cases = signed_permutations();
    cases.push_back({"identity", {1, 0, 0, 0, 1, 0, 0, 0, 1}});
    for (const auto& axis : {std::array<Real, 3>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
        cases.push_back({"half turn about an axis", rounded(turn(axis, kPi))});
    for (int k = 0; k < 50; ++k) {
        cases.push_back({"half turn about a random axis", rounded(turn(random_axis(random), kPi))});
        cases.push_back({"mirror", scaled(random_rotation(random), -1)});
    }
    // Every angle once, then every angle again: who takes only the first cases of a kind has all of them.
    for (int k = 0; k < 20; ++k) {
        for (const Real pole : {Real(0), kPi}) {
            for (int exponent = 1; exponent <= 8; ++exponent) {
                const Exact tilt = turn({0, 1, 0}, pole + std::pow(Real(10), -exponent));
                const Exact before = turn({0, 0, 1}, angle(random)), after = turn({0, 0, 1}, angle(random));
                cases.push_back({"tilt from a pole", rounded(product_of(after, product_of(tilt, before)))});
            }
        }
    }
    for (int k = 0; k < 3000; ++k) {
        const Matrix a = random_rotation(random), z = rounded(turn({0, 0, 1}, angle(random)));
        cases.push_back({"product of rounded matrices that is a z rotation",
                         rounded_product<T>(rounded_product<T>(a, transposed(a)), z)});
    }
    for (const double noise : {1e-3, 1e-5, 1e-7})
        for (int k = 0; k < 300; ++k)
            cases.push_back({fmt::format("orthonormal only to {}", noise),
                             with_noise(random_rotation(random), noise, random)});
    return cases;
}

std::vector<Case> tiny_tilts(std::mt19937_64& random) {
    std::uniform_real_distribution<Real> angle(-kPi, kPi);
    const Exact quarter_turn{0, -1, 0, 1, 0, 0, 0, 0, 1};
    std::vector<Case> cases;
    for (int half_decade = 18; half_decade <= 50; ++half_decade) {
        const Real sine = std::pow(Real(10), -Real(half_decade) / 2), cosine = std::sqrt(1 - sine * sine);
        for (const Real pole : {Real(1), Real(-1)}) {
            const Exact tilt{pole * cosine, 0, sine, 0, 1, 0, -sine, 0, pole * cosine};
            for (const Exact& after : {quarter_turn, turn({0, 0, 1}, angle(random))}) {
                const std::string name = fmt::format("tilt of {:.1e} from a pole", static_cast<double>(sine));
                cases.push_back({name, rounded(product_of(after, tilt))});
                const Exact before = turn({0, 0, 1}, angle(random));
                cases.push_back({name, rounded(product_of(after, product_of(tilt, before)))});
            }
        }
    }
    return cases;
}

Matrix with_noise(Matrix rotation, double noise, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    for (double& entry : rotation) entry += noise * normal(random) / 3;
    return rotation;
}

std::vector<double> random_signal(int order, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    std::vector<double> f(order * order);
    for (double& coefficient : f) coefficient = normal(random);
    return f;
}

std::vector<std::vector<double>> hard_signals(int order, std::mt19937_64& random) {
    std::vector<std::vector<double>> signals;
    const auto band_times = [&](int band, double inside, double outside) {
        std::vector<double> f = random_signal(order, random);
        for (int i = 0; i < order * order; ++i)
            f[i] *= band * band <= i && i < (band + 1) * (band + 1) ? inside : outside;
        return f;
    };
    for (int band = 0; band < order; ++band) {
        signals.push_back(band_times(band, 1, 0));
        signals.push_back(band_times(band, 1e6, 1));
    }
    signals.push_back(band_times(0, 1e30, 1e30));
    signals.push_back(band_times(0, 1e-30, 1e-30));
    signals.push_back(band_times(0, 0, 0));
    return signals;
}

template Matrix rounded_product<float>(const Matrix&, const Matrix&);
template Matrix rounded_product<double>(const Matrix&, const Matrix&);
template std::vector<Case> hard_rotations<float>(std::mt19937_64&);
template std::vector<Case> hard_rotations<double>(std::mt19937_64&);

}  // namespace zonal::cases
