#pragma once

#include "zonal/kernel_support.hpp"

namespace zonal {

/// A signal value of three channels.
/// A kernel is linear in the signal and needs of it only the operations below, a rotation scalar on the left;
/// so `rotate<T, Rgb<T>>` rotates three channels at once and pays once for what depends on the rotation only.
/// Always inlined: a function that files compiled for different targets share could be any file's.
template <class T>
struct Rgb {
    using value_type = T;

    T r, g, b;

    /// Zeros.
    ZONAL_INLINE constexpr Rgb() : r(0), g(0), b(0) {}
    ZONAL_INLINE constexpr Rgb(T red, T green, T blue) : r(red), g(green), b(blue) {}

    template <class U>
    ZONAL_INLINE Rgb<U> cast() const {
        return {static_cast<U>(r), static_cast<U>(g), static_cast<U>(b)};
    }

    friend ZONAL_INLINE bool operator==(const Rgb& p, const Rgb& q) {
        return p.r == q.r && p.g == q.g && p.b == q.b;
    }
    friend ZONAL_INLINE Rgb operator+(const Rgb& p, const Rgb& q) {
        return {p.r + q.r, p.g + q.g, p.b + q.b};
    }
    friend ZONAL_INLINE Rgb operator-(const Rgb& p, const Rgb& q) {
        return {p.r - q.r, p.g - q.g, p.b - q.b};
    }
    friend ZONAL_INLINE Rgb operator-(const Rgb& p) { return {-p.r, -p.g, -p.b}; }
    friend ZONAL_INLINE Rgb operator*(T s, const Rgb& p) { return {s * p.r, s * p.g, s * p.b}; }
    /// s p + q; found by argument-dependent lookup.
    friend ZONAL_INLINE Rgb fma(T s, const Rgb& p, const Rgb& q) {
        using kernel_support::fma;
        return {fma(s, p.r, q.r), fma(s, p.g, q.g), fma(s, p.b, q.b)};
    }
};

}  // namespace zonal
