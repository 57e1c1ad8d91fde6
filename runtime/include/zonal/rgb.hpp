#pragma once

// Everything here is always inlined: a function that files compiled for different targets share could be any
// file's. The same words stand in front of generated kernels.
#ifndef ZONAL_HOST_DEVICE
#if defined(__CUDACC__) || defined(__HIPCC__)
#define ZONAL_HOST_DEVICE __host__ __device__
#else
#define ZONAL_HOST_DEVICE
#endif
#if defined(__GNUC__)
#define ZONAL_INLINE ZONAL_HOST_DEVICE inline __attribute__((always_inline))
#elif defined(_MSC_VER)
#define ZONAL_INLINE ZONAL_HOST_DEVICE __forceinline
#else
#define ZONAL_INLINE ZONAL_HOST_DEVICE inline
#endif
#endif

namespace zonal {
namespace detail {

/// a b + c in one instruction where the target has it, never as a call of the library.
template <class T>
ZONAL_INLINE T multiply_add(T a, T b, T c) {
#if (defined(__FMA__) || defined(__ARM_FEATURE_FMA)) && defined(__GNUC__) && !defined(ZONAL_NO_FMA)
    if constexpr (sizeof(T) == sizeof(float))
        return __builtin_fmaf(a, b, c);
    else
        return __builtin_fma(a, b, c);
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
        return {detail::multiply_add(s, p.r, q.r), detail::multiply_add(s, p.g, q.g),
                detail::multiply_add(s, p.b, q.b)};
    }
};

}  // namespace zonal
