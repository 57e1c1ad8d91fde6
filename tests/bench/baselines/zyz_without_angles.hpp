// Z(a) X⁻¹ Z(b) X Z(g) of one order as straight code. X, the quarter turn about x, is constant and three
// quarters zeros; sines and cosines of a, b and g are entries of R, normalised, those of multiples come by
// recurrence. Two forms: DirectXMath's, which takes a third root for sin b, and one that takes the length of
// R's last column, which is faster and does not cancel near the poles.
//
// X shows what is polar about z about another axis: so its entries are Wigner's functions at 90 degrees up to
// signs, sqrt((l+m)! (l-m)! / ((l+n)! (l-n)!)) / 2^l times the coefficient of x^(l-m) in (1+x)^(l+n)
// (1-x)^(l-n).
//
// Source: E. Wigner, Group Theory, 1959, eq. 15.27; Kautz, Sloan, Snyder 2002. Limits: determinant +1; where
// R leaves the z axis in place but for noise, a and g are made of noise, each of its own, and so is their
// sum.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace zonal::baselines {

namespace zyz {

/// Newton's steps from above fall until they are exact or round up.
constexpr long double square_root(long double x) {
    long double root = x + 1, next = (root + x / root) / 2;
    while (next < root) {
        root = next;
        next = (root + x / root) / 2;
    }
    return root;
}

constexpr long double factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }

/// Row m and column n of band l of the rotation by +90 degrees about x, which takes z to -y and y to z.
constexpr long double quarter_turn(int l, int m, int n) {
    // A function of even l + m is even in z, so its image is even in y, a cosine; parity in x stays.
    const bool is_cosine = (l + m) % 2 == 0, is_even_in_x = (m >= 0) == (m % 2 == 0);
    if ((n >= 0) != is_cosine || (is_cosine == (n % 2 == 0)) != is_even_in_x) return 0;
    const int a = m < 0 ? -m : m, b = n < 0 ? -n : n;
    std::array<long double, 32> coefficients{1};
    for (int degree = 1; degree <= 2 * l; ++degree)
        for (int i = degree; i > 0; --i) coefficients[i] += (degree <= l + b ? 1 : -1) * coefficients[i - 1];
    const int doubled = (a > 0) + (b > 0);  // real functions are sums of two complex ones over root 2
    const long double squared = factorial(l + a) * factorial(l - a) / (factorial(l + b) * factorial(l - b)) /
                                static_cast<long double>(1LL << (2 * l - doubled));
    const int signs = (m < 0 ? a + 1 : a) / 2 + (n < 0 ? b - 1 : b) / 2;
    return (signs % 2 == 0 ? 1 : -1) * coefficients[l - a] * square_root(squared);
}

/// The nonzeros of a row.
template <int l>
struct Row {
    int count = 0;
    std::array<int, l + 1> columns{};
    std::array<long double, l + 1> values{};
};

template <int l>
constexpr Row<l> row_of_quarter_turn(int m, bool is_inverse) {
    Row<l> row;
    for (int n = -l; n <= l; ++n) {
        const long double value = is_inverse ? quarter_turn(l, n, m) : quarter_turn(l, m, n);
        if (value == 0) continue;
        row.columns[row.count] = l + n;
        row.values[row.count++] = value;
    }
    return row;
}

template <int l, int m, bool is_inverse>
inline constexpr Row<l> kRow = row_of_quarter_turn<l>(m, is_inverse);

/// The first `count` terms of a row times v. One expression, since clang++ fuses within expressions only.
template <const auto& row, int count, class T>
[[gnu::always_inline]] inline T product(const T* v) {
    constexpr T value = static_cast<T>(row.values[count - 1]);
    const T& x = v[row.columns[count - 1]];
    if constexpr (count > 1)
        return product<row, count - 1>(v) + value * x;
    else if constexpr (value == 1 || value == -1)
        return value == 1 ? x : -x;
    else
        return value * x;
}

template <bool is_inverse, class T, std::size_t width, int... i>
[[gnu::always_inline]] inline void turn_about_x(std::array<T, width>& v, std::integer_sequence<int, i...>) {
    constexpr int l = width / 2;
    v = {product<kRow<l, i - l, is_inverse>, kRow<l, i - l, is_inverse>.count>(v.data())...};
}

/// Cosines and sines of 1 ... top times an angle, at 0 ... top - 1.
template <int top, class T>
struct Multiples {
    std::array<T, top> cosines, sines;

    [[gnu::always_inline]] Multiples(T cosine, T sine) {
        const T twice = cosine + cosine;
        cosines[0] = cosine, sines[0] = sine;
        cosines[1] = twice * cosine - 1, sines[1] = twice * sine;
        for (int m = 2; m < top; ++m) {
            cosines[m] = twice * cosines[m - 1] - cosines[m - 2];
            sines[m] = twice * sines[m - 1] - sines[m - 2];
        }
    }
};

template <int top, class T, std::size_t width, int... i>
[[gnu::always_inline]] inline void turn_about_z(const Multiples<top, T>& angle, std::array<T, width>& v,
                                                std::integer_sequence<int, i...>) {
    const auto turn_pair = [](T cosine, T sine, T & c, T & s) __attribute__((always_inline)) {
        const T before = c;
        c = cosine * before - sine * s;
        s = sine * before + cosine * s;
    };
    constexpr int l = width / 2;
    (turn_pair(angle.cosines[i], angle.sines[i], v[l + 1 + i], v[l - 1 - i]), ...);
}

template <int l, int top, class T>
[[gnu::always_inline]] inline void turn_band(const Multiples<top, T>& alpha, const Multiples<top, T>& beta,
                                             const Multiples<top, T>& gamma, const T* f, T* out) {
    constexpr std::make_integer_sequence<int, 2 * l + 1> kRows;
    constexpr std::make_integer_sequence<int, l> kPairs;
    std::array<T, 2 * l + 1> v;
    std::copy_n(f + l * l, v.size(), v.begin());
    turn_about_z(gamma, v, kPairs);
    turn_about_x<false>(v, kRows);
    turn_about_z(beta, v, kPairs);
    turn_about_x<true>(v, kRows);
    turn_about_z(alpha, v, kPairs);
    std::copy_n(v.begin(), v.size(), out + l * l);
}

template <int top, class T, int... i>
[[gnu::always_inline]] inline void turn_bands(const Multiples<top, T>& alpha, const Multiples<top, T>& beta,
                                              const Multiples<top, T>& gamma, const T* f, T* out,
                                              std::integer_sequence<int, i...>) {
    (turn_band<i + 2>(alpha, beta, gamma, f, out), ...);
}

}  // namespace zyz

/// Highest order of zyz_without_angles: straight code of more takes long to compile.
inline constexpr int kLastZyzOrder = 10;

/// Where sin b comes from.
enum class SineOfBeta { root_of_cosine, length_of_column };

/// R : row-major, orthonormal, determinant +1. f, out: N^2 values, index l(l+1)+m; out may be f.
/// N is 2 ... 10, T float or double.
template <int N, SineOfBeta form, class T>
inline void zyz_without_angles(const T* R, const T* f, T* out) {
    static_assert(N >= 2 && N <= kLastZyzOrder);
    const T y = f[1], z = f[2], x = f[3];
    out[0] = f[0];
    out[1] = R[3] * x + R[4] * y + R[5] * z;
    out[2] = R[6] * x + R[7] * y + R[8] * z;
    out[3] = R[0] * x + R[1] * y + R[2] * z;
    if constexpr (N > 2) {
        // The last column's x and y are sin b (cos a, sin a), the last row's sin b (-cos g, sin g). Where
        // they vanish a is 0.
        constexpr T kSmallest = std::numeric_limits<T>::min() / std::numeric_limits<T>::epsilon();
        const T column = R[2] * R[2] + R[5] * R[5], row = R[6] * R[6] + R[7] * R[7];
        T cos_alpha = 1, sin_alpha = 0, sin_beta = 0, cos_gamma = R[4], sin_gamma = R[3];
        if (std::min(column, row) > kSmallest) {
            const T length = std::sqrt(column);
            sin_beta =
                form == SineOfBeta::length_of_column ? length : std::sqrt(std::max(T(0), 1 - R[8] * R[8]));
            const T over_column = 1 / length, over_row = 1 / std::sqrt(row);
            cos_alpha = R[2] * over_column, sin_alpha = R[5] * over_column;
            cos_gamma = -R[6] * over_row, sin_gamma = R[7] * over_row;
        }
        zyz::turn_bands(
            zyz::Multiples<N - 1, T>(cos_alpha, sin_alpha), zyz::Multiples<N - 1, T>(R[8], sin_beta),
            zyz::Multiples<N - 1, T>(cos_gamma, sin_gamma), f, out, std::make_integer_sequence<int, N - 2>());
    }
}

}  // namespace zonal::baselines
