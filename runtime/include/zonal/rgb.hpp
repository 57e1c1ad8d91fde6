#pragma once

#include <cmath>

namespace zonal {
namespace detail {

/// a b + c in one instruction where the target has it, never as a call of the library.
template <class T>
T multiply_add(T a, T b, T c) {
#if (defined(__FMA__) || defined(__ARM_FEATURE_FMA)) && !defined(ZONAL_NO_FMA)
    return std::fma(a, b, c);
#else
    return a * b + c;
#endif
}

}  // namespace detail

/// A signal value of three channels.
/// A kernel is linear in the signal and needs of it only the operations below, a rotation scalar on the left;
/// so `rotate<T, Rgb<T>>` turns three channels at once and pays once for what depends on the rotation only.
template <class T>
struct Rgb {
    using value_type = T;

    T r = 0;
    T g = 0;
    T b = 0;

    template <class U>
    Rgb<U> cast() const {
        return {static_cast<U>(r), static_cast<U>(g), static_cast<U>(b)};
    }

    friend bool operator==(const Rgb&, const Rgb&) = default;
    friend Rgb operator+(const Rgb& p, const Rgb& q) { return {p.r + q.r, p.g + q.g, p.b + q.b}; }
    friend Rgb operator-(const Rgb& p, const Rgb& q) { return {p.r - q.r, p.g - q.g, p.b - q.b}; }
    friend Rgb operator-(const Rgb& p) { return {-p.r, -p.g, -p.b}; }
    friend Rgb operator*(T s, const Rgb& p) { return {s * p.r, s * p.g, s * p.b}; }
    /// s p + q; found by argument-dependent lookup.
    friend Rgb fma(T s, const Rgb& p, const Rgb& q) {
        return {detail::multiply_add(s, p.r, q.r), detail::multiply_add(s, p.g, q.g),
                detail::multiply_add(s, p.b, q.b)};
    }
};

}  // namespace zonal
