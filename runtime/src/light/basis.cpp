// Evaluates real orthonormal spherical harmonics at a unit vector (x, y, z).
//
// y_l^m = Q_l^m(z) c_m and y_l^-m = Q_l^m(z) s_m, where c_m + i s_m = (x + i y)^m = sin^m(theta) e^(i m phi)
// and Q_l^m = sqrt(2 - [m = 0]) K_l^m P_l^m(z) / sin^m(theta) is a polynomial in z. So nothing is divided by
// sin(theta) and the poles are ordinary points. The Q follow from the normalised three-term recurrence in l,
// which is stable upwards.
// Source: W. H. Press et al., Numerical Recipes, 3rd ed., section 6.7, with sin^m(theta) taken out.
// Limit : orders up to kMaxOrder.

#include "zonal/basis.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "core/checks.hpp"

namespace zonal {
namespace {

/// Q_l^m = step(l, m) (z Q_{l-1}^m - Q_{l-2}^m / step(l-1, m)) for l > m, where Q_{m-1}^m = 0.
struct Recurrence {
    std::array<double, kMaxOrder> start;                        // Q_m^m, a constant
    std::array<std::array<double, kMaxOrder>, kMaxOrder> step;  // [l][m]

    Recurrence() : start{}, step{} {
        start[0] = std::sqrt(0.25 / std::numbers::pi);
        for (int m = 1; m < kMaxOrder; ++m) {
            const double doubling = m == 1 ? 2.0 : 1.0;  // every m > 0 has the factor sqrt(2), m = 0 has not
            start[m] = start[m - 1] * std::sqrt(doubling * (2.0 * m + 1.0) / (2.0 * m));
        }
        for (int l = 1; l < kMaxOrder; ++l) {
            for (int m = 0; m < l; ++m) step[l][m] = std::sqrt((4.0 * l * l - 1.0) / (1.0 * l * l - m * m));
        }
    }
};

template <class V>
V weighted_sum(int order, std::span<const V> coefficients, const Direction& direction) {
    check_order(order);
    check_length("coefficients", order, coefficients.size());
    std::array<double, kMaxOrder * kMaxOrder> storage;
    const std::span<double> basis = std::span(storage).first(coefficients.size());
    evaluate_basis(order, direction, basis);
    V sum{};
    for (std::size_t i = 0; i < basis.size(); ++i) sum = sum + basis[i] * coefficients[i];
    return sum;
}

}  // namespace

void evaluate_basis(int order, const Direction& direction, std::span<double> values) {
    static const Recurrence recurrence;
    check_order(order);
    check_length("values", order, values.size());

    const double x = direction.x;
    const double y = direction.y;
    const double z = direction.z;
    double c = 1.0;  // c_m and s_m of the comment above
    double s = 0.0;
    for (int m = 0; m < order; ++m) {
        double before = 0.0;  // Q_{l-2}^m / step(l-1, m)
        double q = recurrence.start[m];
        for (int l = m; l < order; ++l) {
            if (l > m) {
                const double step = recurrence.step[l][m];
                const double next = step * (z * q - before);
                before = q / step;
                q = next;
            }
            values[l * (l + 1) - m] = q * s;
            values[l * (l + 1) + m] = q * c;  // second, so that m = 0 gets the cosine
        }
        const double next_c = x * c - y * s;
        s = x * s + y * c;
        c = next_c;
    }
}

double evaluate(int order, std::span<const double> coefficients, const Direction& direction) {
    return weighted_sum(order, coefficients, direction);
}

Rgb<double> evaluate(int order, std::span<const Rgb<double>> coefficients, const Direction& direction) {
    return weighted_sum(order, coefficients, direction);
}

}  // namespace zonal
