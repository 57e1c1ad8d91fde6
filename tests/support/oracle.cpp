#include "support/oracle.hpp"

#include <cmath>
#include <numbers>
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

std::vector<Real> basis(int order, const Vector3& direction) {
    const Real phi = std::atan2(direction[1], direction[0]);
    const Real z = direction[2], sine = std::hypot(direction[0], direction[1]);
    std::vector<Real> values(order * order);
    Real sectoral = std::sqrt(1 / (4 * kPi));  // normalised P_m^m
    for (int m = 0; m < order; ++m) {
        if (m > 0) sectoral *= sine * std::sqrt((2 * m + 1) / (2.0L * m));
        Real previous = 0, current = sectoral;
        for (int l = m; l < order; ++l) {
            if (l > m) {
                const Real a = std::sqrt((4.0L * l * l - 1) / (l * l - m * m));
                const Real b = std::sqrt(((l - 1.0L) * (l - 1) - m * m) / (4.0L * (l - 1) * (l - 1) - 1));
                previous = std::exchange(current, a * (z * current - b * previous));
            }
            const int center = l * (l + 1);
            if (m == 0) {
                values[center] = current;
            } else {
                values[center + m] = std::numbers::sqrt2_v<Real> * current * std::cos(m * phi);
                values[center - m] = std::numbers::sqrt2_v<Real> * current * std::sin(m * phi);
            }
        }
    }
    return values;
}

Real evaluate(int order, const std::vector<Real>& f, const Vector3& direction) {
    const std::vector<Real> values = basis(order, direction);
    Real sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += f[i] * values[i];
    return sum;
}

Matrix3 nearest_orthonormal(const Matrix3& rotation) {
    Matrix3 x = rotation;
    for (int step = 0; step < 12; ++step) {  // quadratic: a start within 0.1 is exact after 5
        const Matrix3 y = inverse_transposed(x);
        for (int i = 0; i < 9; ++i) x[i] = (x[i] + y[i]) / 2;
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
    for (const auto& [z, weight] : gauss_legendre(order)) {
        for (int k = 0; k < columns; ++k) {
            const Real phi = 2 * kPi * (k + 0.3L) / columns, sine = std::sqrt(1 - z * z);
            Node node{{sine * std::cos(phi), sine * std::sin(phi), z}, {}};
            node.weighted_basis = basis(order, node.direction);
            for (Real& value : node.weighted_basis) value *= weight * 2 * kPi / columns;
            nodes_.push_back(std::move(node));
        }
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
    std::vector<Real> result(order_ * order_, 0);
    for (const Node& node : nodes_) {
        const Real value = evaluate(order_, f, turned_back(q, node.direction));
        for (std::size_t i = 0; i < result.size(); ++i) result[i] += value * node.weighted_basis[i];
    }
    return result;
}

std::vector<std::vector<Real>> Rotation::blocks(const Matrix3& rotation) const {
    const Matrix3 q = nearest_orthonormal(rotation);
    std::vector<std::vector<Real>> blocks;
    for (int l = 0; l < order_; ++l) blocks.emplace_back((2 * l + 1) * (2 * l + 1), 0);
    for (const Node& node : nodes_) {
        const std::vector<Real> turned = basis(order_, turned_back(q, node.direction));
        for (int l = 0; l < order_; ++l) {
            const int size = 2 * l + 1;
            for (int i = 0; i < size; ++i)
                for (int j = 0; j < size; ++j)
                    blocks[l][i * size + j] += node.weighted_basis[l * l + i] * turned[l * l + j];
        }
    }
    return blocks;
}

}  // namespace zonal::oracle
