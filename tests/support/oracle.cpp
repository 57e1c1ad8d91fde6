#include "support/oracle.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace zonal::oracle {

namespace {

constexpr Real kPi = std::numbers::pi_v<Real>;

Real determinant(const Matrix3& m) {
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
           m[2] * (m[3] * m[7] - m[4] * m[6]);
}

Matrix3 inverse_transposed(const Matrix3& m) {
    const Real d = determinant(m);
    return {
        (m[4] * m[8] - m[5] * m[7]) / d, (m[5] * m[6] - m[3] * m[8]) / d, (m[3] * m[7] - m[4] * m[6]) / d,
        (m[2] * m[7] - m[1] * m[8]) / d, (m[0] * m[8] - m[2] * m[6]) / d, (m[1] * m[6] - m[0] * m[7]) / d,
        (m[1] * m[5] - m[2] * m[4]) / d, (m[2] * m[3] - m[0] * m[5]) / d, (m[0] * m[4] - m[1] * m[3]) / d};
}

/// Nodes and weights of Gauss-Legendre quadrature on [-1, 1].
std::vector<std::pair<Real, Real>> gauss_legendre(int count) {
    std::vector<std::pair<Real, Real>> result;
    for (int k = 0; k < count; ++k) {
        Real z = std::cos(kPi * (k + 0.75L) / (count + 0.5L)), derivative = 0;
        for (int step = 0; step < 8; ++step) {
            Real previous = 1, value = z;
            for (int l = 2; l <= count; ++l)
                previous = std::exchange(value, ((2 * l - 1) * z * value - (l - 1) * previous) / l);
            derivative = count * (z * value - previous) / (z * z - 1);
            if (count == 1) derivative = 1;
            z -= value / derivative;
        }
        result.emplace_back(z, 2 / ((1 - z * z) * derivative * derivative));
    }
    return result;
}

}  // namespace

namespace {

/// Orders above are refused: no test asks for them.
constexpr int kLargestOrder = 64;

/// Of the normalised Legendre functions P_m^m = starts[m] sin^m θ and, with z = cos θ,
/// P_l^m = steps[l, m] z P_{l-1}^m - backs[l, m] P_{l-2}^m: the numbers, which hold roots, are made once.
class Legendre {
  public:
    Legendre() {
        starts_.push_back(std::sqrt(1 / (4 * kPi)));
        for (int m = 1; m < kLargestOrder; ++m)
            starts_.push_back(starts_.back() * std::sqrt((2 * m + 1) / (2.0L * m)));
        steps_.resize(kLargestOrder * kLargestOrder);
        backs_.resize(kLargestOrder * kLargestOrder);
        for (int m = 0; m < kLargestOrder; ++m) {
            for (int l = m + 1; l < kLargestOrder; ++l) {
                const Real a = std::sqrt((4.0L * l * l - 1) / (l * l - m * m));
                const Real b = std::sqrt(((l - 1.0L) * (l - 1) - m * m) / (4.0L * (l - 1) * (l - 1) - 1));
                steps_[at(m) + l] = a;
                backs_[at(m) + l] = a * b;
            }
        }
    }
    Real start(int m) const { return starts_[m]; }
    /// Entry l is what leads to P_l^m.
    const Real* steps(int m) const { return steps_.data() + at(m); }
    const Real* backs(int m) const { return backs_.data() + at(m); }

  private:
    static std::size_t at(int m) { return static_cast<std::size_t>(m) * kLargestOrder; }
    std::vector<Real> starts_, steps_, backs_;
};

const Legendre& legendre(int order) {
    if (order > kLargestOrder) throw std::out_of_range("the oracle knows orders up to 64");
    static const Legendre all;
    return all;
}

/// e^{imφ} sin^m θ for m = 0 … : powers of x + iy.
class Powers {
  public:
    explicit Powers(const Vector3& direction) : x_(direction[0]), y_(direction[1]) {}
    Real cosine() const { return cosine_; }
    Real sine() const { return sine_; }
    void advance() {
        const Real c = cosine_ * x_ - sine_ * y_;
        sine_ = cosine_ * y_ + sine_ * x_;
        cosine_ = c;
    }

  private:
    Real x_, y_, cosine_ = 1, sine_ = 0;
};

constexpr Real kSqrt2 = std::numbers::sqrt2_v<Real>;

}  // namespace

std::vector<Real> basis(int order, const Vector3& direction) {
    const Legendre& numbers = legendre(order);
    const Real z = direction[2];
    std::vector<Real> values(order * order);
    Powers powers(direction);
    for (int m = 0; m < order; ++m, powers.advance()) {
        const Real *steps = numbers.steps(m), *backs = numbers.backs(m);
        Real previous = 0, current = numbers.start(m);
        for (int l = m; l < order; ++l) {
            if (l > m) previous = std::exchange(current, steps[l] * z * current - backs[l] * previous);
            const int center = l * (l + 1);
            if (m == 0) {
                values[center] = current;
            } else {
                values[center + m] = kSqrt2 * current * powers.cosine();
                values[center - m] = kSqrt2 * current * powers.sine();
            }
        }
    }
    return values;
}

Real evaluate(int order, const std::vector<Real>& f, const Vector3& direction) {
    const Legendre& numbers = legendre(order);
    const Real z = direction[2];
    Powers powers(direction);
    Real value = 0;
    for (int m = 0; m < order; ++m, powers.advance()) {
        const Real *steps = numbers.steps(m), *backs = numbers.backs(m);
        Real previous = 0, current = numbers.start(m), with_cosine = 0, with_sine = 0;
        for (int l = m;;) {
            with_cosine += f[l * (l + 1) + m] * current;
            with_sine += f[l * (l + 1) - m] * current;
            if (++l == order) break;
            previous = std::exchange(current, steps[l] * z * current - backs[l] * previous);
        }
        if (m == 0)
            value += with_cosine;
        else
            value += kSqrt2 * (with_cosine * powers.cosine() + with_sine * powers.sine());
    }
    return value;
}

Matrix3 nearest_orthonormal(const Matrix3& rotation) {
    Matrix3 x = rotation;
    for (int step = 0; step < 12; ++step) {
        const Matrix3 y = inverse_transposed(x);
        Real change = 0;
        for (int i = 0; i < 9; ++i) {
            change = std::max(change, std::abs(y[i] - x[i]) / 2);
            x[i] = (x[i] + y[i]) / 2;
        }
        if (change < 1e-11L) break;  // quadratic: what is left is about the square of it
    }
    return x;
}

Real orthonormality_error(const Matrix3& r) {
    Real sum = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            Real product = i == j ? -1 : 0;
            for (int k = 0; k < 3; ++k) product += r[3 * i + k] * r[3 * j + k];
            sum += product * product;
        }
    }
    return std::sqrt(sum);
}

Rotation::Rotation(int order) : order_(order) {
    const int columns = 2 * order - 1;
    for (int k = 0; k < columns; ++k) {
        const Real phi = 2 * kPi * (k + 0.3L) / columns;
        for (int m = 0; m < order; ++m) {
            const Real scale = (m == 0 ? 1 : kSqrt2) * 2 * kPi / columns;
            cosines_.push_back(scale * std::cos(m * phi));
            sines_.push_back(scale * std::sin(m * phi));
        }
    }
    for (const auto& [z, weight] : gauss_legendre(order)) {
        const Real sine = std::sqrt(1 - z * z);
        Ring ring;
        for (int k = 0; k < columns; ++k) {
            const Real phi = 2 * kPi * (k + 0.3L) / columns;
            ring.directions.push_back({sine * std::cos(phi), sine * std::sin(phi), z});
        }
        // At φ = 0 the basis is the Legendre functions alone, with √2 where m is not 0.
        const std::vector<Real> values = basis(order, {sine, 0, z});
        for (int l = 0; l < order; ++l)
            for (int m = 0; m <= l; ++m)
                ring.weighted_legendre.push_back(weight * values[l * (l + 1) + m] / (m == 0 ? 1 : kSqrt2));
        rings_.push_back(std::move(ring));
    }
}

namespace {

/// Qᵀ w.
Vector3 turned_back(const Matrix3& q, const Vector3& w) {
    return {q[0] * w[0] + q[3] * w[1] + q[6] * w[2], q[1] * w[0] + q[4] * w[1] + q[7] * w[2],
            q[2] * w[0] + q[5] * w[1] + q[8] * w[2]};
}

}  // namespace

std::vector<Real> Rotation::operator()(const Matrix3& rotation, const std::vector<Real>& f) const {
    const Matrix3 q = nearest_orthonormal(rotation);
    std::vector<Real> result(order_ * order_, 0), with_cosine(order_), with_sine(order_);
    for (const Ring& ring : rings_) {
        // The integral over φ first, then over z.
        std::fill(with_cosine.begin(), with_cosine.end(), 0);
        std::fill(with_sine.begin(), with_sine.end(), 0);
        const Real *cosine = cosines_.data(), *sine = sines_.data();
        for (const Vector3& direction : ring.directions) {
            const Real value = evaluate(order_, f, turned_back(q, direction));
            for (int m = 0; m < order_; ++m) {
                with_cosine[m] += value * *cosine++;
                with_sine[m] += value * *sine++;
            }
        }
        const Real* legendre = ring.weighted_legendre.data();
        for (int l = 0; l < order_; ++l) {
            const int center = l * (l + 1);
            result[center] += *legendre++ * with_cosine[0];
            for (int m = 1; m <= l; ++m, ++legendre) {
                result[center + m] += *legendre * with_cosine[m];
                result[center - m] += *legendre * with_sine[m];
            }
        }
    }
    return result;
}

std::vector<std::vector<Real>> Rotation::blocks(const Matrix3& rotation) const {
    const Matrix3 q = nearest_orthonormal(rotation);
    std::vector<std::vector<Real>> blocks;
    for (int l = 0; l < order_; ++l) blocks.emplace_back((2 * l + 1) * (2 * l + 1), 0);
    for (const Ring& ring : rings_) {
        const Real *cosine = cosines_.data(), *sine = sines_.data();
        for (const Vector3& direction : ring.directions) {
            const std::vector<Real> turned = basis(order_, turned_back(q, direction));
            const Real* legendre = ring.weighted_legendre.data();
            for (int l = 0; l < order_; ++l) {
                const int size = 2 * l + 1;
                for (int m = 0; m <= l; ++m, ++legendre) {
                    Real *above = &blocks[l][(l + m) * size], *below = &blocks[l][(l - m) * size];
                    const Real with_cosine = *legendre * cosine[m], with_sine = *legendre * sine[m];
                    for (int j = 0; j < size; ++j) {
                        above[j] += with_cosine * turned[l * l + j];
                        if (m > 0) below[j] += with_sine * turned[l * l + j];
                    }
                }
            }
            cosine += order_;
            sine += order_;
        }
    }
    return blocks;
}

}  // namespace zonal::oracle
