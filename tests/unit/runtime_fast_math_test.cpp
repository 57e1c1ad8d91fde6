// Compiled with -ffast-math, which lets a compiler take every value for finite.

#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <limits>
#include <string>

#include "zonal/error.hpp"
#include "zonal/finite.hpp"
#include "zonal/rotation.hpp"

#ifndef __FAST_MATH__
#error "this file tests what happens under -ffast-math"
#endif

namespace {

using zonal::detail::is_finite;
using zonal::detail::is_nan;

/// From bits that no compiler knows.
float float_of(std::uint32_t bits) {
    volatile std::uint32_t unknown = bits;
    return std::bit_cast<float>(static_cast<std::uint32_t>(unknown));
}
double double_of(std::uint64_t bits) {
    volatile std::uint64_t unknown = bits;
    return std::bit_cast<double>(static_cast<std::uint64_t>(unknown));
}

TEST(runtime_fast_math, floats_are_told_by_their_bits) {
    for (const std::uint32_t bits : {0x7F800000U, 0xFF800000U}) {
        EXPECT_FALSE(is_finite(float_of(bits)));
        EXPECT_FALSE(is_nan(float_of(bits)));
    }
    for (const std::uint32_t bits : {0x7FC00000U, 0xFFC00000U, 0x7F800001U, 0xFFFFFFFFU}) {
        EXPECT_FALSE(is_finite(float_of(bits)));
        EXPECT_TRUE(is_nan(float_of(bits)));
    }
    for (const std::uint32_t bits : {0U, 0x80000000U, 1U, 0x7F7FFFFFU, 0xFF7FFFFFU, 0x3F800000U}) {
        EXPECT_TRUE(is_finite(float_of(bits)));
        EXPECT_FALSE(is_nan(float_of(bits)));
    }
}

TEST(runtime_fast_math, doubles_are_told_by_their_bits) {
    for (const std::uint64_t bits : {0x7FF0000000000000U, 0xFFF0000000000000U}) {
        EXPECT_FALSE(is_finite(double_of(bits)));
        EXPECT_FALSE(is_nan(double_of(bits)));
    }
    for (const std::uint64_t bits : {0x7FF8000000000000U, 0xFFF8000000000000U, 0x7FF0000000000001U}) {
        EXPECT_FALSE(is_finite(double_of(bits)));
        EXPECT_TRUE(is_nan(double_of(bits)));
    }
    for (const std::uint64_t bits :
         {std::uint64_t{0}, std::uint64_t{1} << 63, std::uint64_t{1}, 0x7FEFFFFFFFFFFFFFU}) {
        EXPECT_TRUE(is_finite(double_of(bits)));
        EXPECT_FALSE(is_nan(double_of(bits)));
    }
}

template <class T>
std::string message_of_check(T value) {
    try {
        zonal::checked_rotation(zonal::RotationMatrix<T>(1, 0, 0, 0, 1, value, 0, 0, 1), 1e9);
    } catch (const zonal::Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(runtime_fast_math, checked_rotation_refuses_values_that_are_not_finite) {
    EXPECT_NE(message_of_check(float_of(0x7FC00000U)).find("row 1, column 2: found nan"), std::string::npos);
    EXPECT_NE(message_of_check(float_of(0xFF800000U)).find("row 1, column 2: found -inf"), std::string::npos);
    EXPECT_NE(message_of_check(double_of(0x7FF8000000000000U)).find("found nan"), std::string::npos);
    EXPECT_NE(message_of_check(double_of(0x7FF0000000000000U)).find("found inf"), std::string::npos);
    EXPECT_EQ(message_of_check(0.0F), "no error");
}

TEST(runtime_fast_math, tolerance_that_is_not_a_number_accepts_nothing) {
    EXPECT_THROW(zonal::checked_rotation(zonal::RotationMatrix<float>(), double_of(0x7FF8000000000000U)),
                 zonal::Error);
}

}  // namespace
