#pragma once

#include <bit>
#include <cstdint>

// Tests of the bits of a value: -ffast-math lets a compiler take std::isfinite for true and std::isnan for
// false.

namespace zonal::detail {

inline constexpr std::uint32_t kFloatExponent = 0x7F800000U;
inline constexpr std::uint64_t kDoubleExponent = 0x7FF0000000000000U;

/// Neither NaN nor infinite.
constexpr bool is_finite(float value) {
    return (std::bit_cast<std::uint32_t>(value) & kFloatExponent) != kFloatExponent;
}
constexpr bool is_finite(double value) {
    return (std::bit_cast<std::uint64_t>(value) & kDoubleExponent) != kDoubleExponent;
}

constexpr bool is_nan(float value) {
    return (std::bit_cast<std::uint32_t>(value) & ~(std::uint32_t{1} << 31)) > kFloatExponent;
}
constexpr bool is_nan(double value) {
    return (std::bit_cast<std::uint64_t>(value) & ~(std::uint64_t{1} << 63)) > kDoubleExponent;
}

}  // namespace zonal::detail
