#include "exact/legendre.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

namespace zonal::exact {

std::vector<Real> monic_legendre_derivative(int l, int m) {
    // From P_l(z) = 2^-l sum_j (-1)^j binom(l, j) binom(2l - 2j, l) z^(l-2j), differentiated m times, as the
    // ratio of consecutive terms.
    const int degree = l - m;
    std::vector<Real> coefficients{Real{1}};
    for (int j = 0; 2 * (j + 1) <= degree; ++j) {
        const int numerator = -(degree - 2 * j) * (degree - 2 * j - 1);
        const int denominator = 2 * (j + 1) * (2 * l - 2 * j - 1);
        coefficients.push_back(coefficients.back() * numerator / denominator);
    }
    return coefficients;
}

Real basis_scale(int l, int m) {
    const int order = m < 0 ? -m : m;
    // K_l^m with its square root, times the leading coefficient (2l)! / (2^l l! (l-m)!).
    Real leading{1};
    for (int k = l + 1; k <= 2 * l; ++k) leading *= k;
    for (int k = 1; k <= l - order; ++k) leading /= k;
    leading = ldexp(leading, -l);
    Real factorial_ratio{1};
    for (int k = l - order + 1; k <= l + order; ++k) factorial_ratio *= k;
    const Real norm = Real(order == 0 ? 1 : 2) * (2 * l + 1) / (4 * pi() * factorial_ratio);
    return leading * sqrt(norm);
}

std::vector<Real> legendre_zeros(int l, int m) {
    const int degree = l - m;
    std::vector<Real> zeros;
    if (degree < 2) return zeros;
    Matrix<double> jacobi = Matrix<double>::Zero(degree, degree);
    for (int k = 1; k < degree; ++k) {
        // Recurrence coefficient of the monic Gegenbauer polynomials, lambda = m + 1/2.
        const double square = k * (k + 2 * m) / ((2 * (k + m) + 1.0) * (2 * (k + m) - 1.0));
        jacobi(k, k - 1) = jacobi(k - 1, k) = std::sqrt(square);
    }
    const Eigen::SelfAdjointEigenSolver<Matrix<double>> solver(jacobi, Eigen::EigenvaluesOnly);
    const std::vector<Real> coefficients = monic_legendre_derivative(l, m);
    for (int k = degree - degree / 2; k < degree; ++k) {
        // The zeros are simple, so each Newton step doubles the digits: 16, 32, 64.
        Real z = solver.eigenvalues()(k);
        for (int step = 0; step < 3; ++step) {
            const Real square = z * z;
            Real value = 0, derivative = 0;  // of the polynomial in z^2 that is left without the zero at 0
            for (const Real& coefficient : coefficients) {
                derivative = derivative * square + value;
                value = value * square + coefficient;
            }
            z -= value / (2 * z * derivative);
        }
        zeros.push_back(z);
    }
    return zeros;
}

}  // namespace zonal::exact
