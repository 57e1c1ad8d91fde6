// Closed forms of Legendre zeros. With d = l - m the polynomial left of P_l^m, in u = z^2, begins
//   u^(d/2) - d (d-1) / (2 (2l-1)) u^(d/2-1) + d (d-1) (d-2) (d-3) / (8 (2l-1) (2l-3)) u^(d/2-2) - …,
// so for d = 2, 3 its zero is the fraction d (d-1) / (2 (2l-1)), and for d = 4, 5 its zeros are
// (a -+ b sqrt(r)) / c with integers that are small for every band of interest.

#include "search/closed_form_zeros.hpp"

#include <fmt/format.h>

#include <numeric>

#include "exact/angles.hpp"
#include "exact/legendre.hpp"

namespace zonal::search {
namespace {

/// Text of a zero of the linear polynomial: cos^2(theta) as a fraction.
std::string linear_zero(long l, long d) {
    const long numerator = d * (d - 1), denominator = 2 * (2 * l - 1);
    const long common = std::gcd(numerator, denominator);
    return fmt::format("acos(sqrt({}/{}))", numerator / common, denominator / common);
}

/// Text of a zero of the quadratic polynomial u^2 - 2 s u + t: s = p/q, and s^2 - t = v/w.
std::string quadratic_zero(long l, long d, char sign) {
    const long p = d * (d - 1), q = 4 * (2 * l - 1);
    const long t_numerator = d * (d - 1) * (d - 2) * (d - 3), t_denominator = 2 * q * (2 * l - 3);
    long v = p * p * t_denominator - t_numerator * q * q, w = q * q * t_denominator;
    const long common = std::gcd(v, w);
    v /= common;
    w /= common;
    // sqrt(v/w) = b sqrt(r) / w with r free of squares.
    long r = v * w, b = 1;
    for (long factor = 2; factor * factor <= r; ++factor) {
        for (; r % (factor * factor) == 0; r /= factor * factor) b *= factor;
    }
    // p/q -+ b sqrt(r)/w over one denominator.
    long c = std::lcm(q, w), a = p * (c / q);
    b *= c / w;
    const long reduce = std::gcd(std::gcd(a, b), c);
    a /= reduce;
    b /= reduce;
    c /= reduce;
    const std::string root = b == 1 ? fmt::format("sqrt({})", r) : fmt::format("{}*sqrt({})", b, r);
    return fmt::format("acos(sqrt(({}{}{})/{}))", a, sign, root, c);
}

}  // namespace

std::vector<Angle> legendre_zero_angles(int l, int m) {
    const int degree = l - m;
    std::vector<Angle> angles;
    for (const exact::Real& z : exact::legendre_zeros(l, m)) angles.push_back({acos(z), ""});
    if (degree / 2 == 1) angles[0].text = linear_zero(l, degree);
    if (degree / 2 == 2) {
        angles[0].text = quadratic_zero(l, degree, '-');
        angles[1].text = quadratic_zero(l, degree, '+');
    }
    for (Angle& angle : angles) {
        if (angle.text.empty()) angle.text = exact::decimal_text(angle.value);
    }
    return angles;
}

Angle fraction_of_pi(int k, int n) {
    const int common = std::gcd(k, n);
    const int numerator = k / common, denominator = n / common;
    const exact::Real value = exact::pi() * numerator / denominator;
    if (numerator == 0) return {exact::Real{0}, "0"};
    const std::string times_pi = numerator == 1 ? "pi" : fmt::format("{}*pi", numerator);
    return {value, denominator == 1 ? times_pi : fmt::format("{}/{}", times_pi, denominator)};
}

}  // namespace zonal::search
