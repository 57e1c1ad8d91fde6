#pragma once

#include <compare>
#include <concepts>
#include <cstddef>
#include <iosfwd>
#include <string>

namespace zonal::exact {

/// A number of 50 decimal digits, every operation rounded to nearest: what decides which factorization
/// entries are zero, and what every emitted constant is rounded from. It is Boost's cpp_bin_float_50 behind
/// plain functions: templates that take seconds to compile in every file that uses them are compiled in
/// real.cpp alone.
class Real {
  public:
    Real() : Real(0LL) {}
    template <std::integral T>
    Real(T value) : Real(static_cast<long long>(value)) {}
    Real(long long value);
    Real(double value);
    /// A decimal, with an exponent of at most four digits or without. Throws std::runtime_error where it is
    /// none.
    explicit Real(const char* decimal);
    explicit Real(const std::string& decimal) : Real(decimal.c_str()) {}
    Real(const Real& other) noexcept;
    Real& operator=(const Real& other) noexcept;
    ~Real() = default;

    explicit operator double() const;
    explicit operator int() const;  ///< towards zero

    /// So many significant digits, as short as `%g` has them.
    std::string str(int digits) const;

    Real& operator+=(const Real& other);
    Real& operator-=(const Real& other);
    Real& operator*=(const Real& other);
    Real& operator/=(const Real& other);
    Real operator-() const;
    friend Real operator+(const Real& a, const Real& b);
    friend Real operator-(const Real& a, const Real& b);
    friend Real operator*(const Real& a, const Real& b);
    friend Real operator/(const Real& a, const Real& b);
    friend bool operator==(const Real& a, const Real& b);
    friend std::partial_ordering operator<=>(const Real& a, const Real& b);

    friend Real abs(const Real& a);
    friend Real sqrt(const Real& a);
    friend Real sin(const Real& a);
    friend Real cos(const Real& a);
    friend Real acos(const Real& a);
    friend Real floor(const Real& a);
    friend Real round(const Real& a);
    friend Real ldexp(const Real& a, int exponent);
    friend Real pow(const Real& a, int exponent);
    friend std::ostream& operator<<(std::ostream& stream, const Real& a);
    friend const Real& pi();

  private:
    struct Access;
    alignas(16) std::byte storage_[64];  ///< holds the Boost number
};

/// 3.14159…
const Real& pi();

/// An entry of a factorization smaller than this is zero (design section 4.1). Inverting a band of condition
/// 50 at 50 digits leaves about 1e-46, so the margin on both sides is wide.
inline const Real kZeroThreshold{"1e-30"};

}  // namespace zonal::exact
