#include "exact/real.hpp"

#include <algorithm>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <new>
#include <ostream>
#include <stdexcept>
#include <string_view>
#include <type_traits>

namespace zonal::exact {
namespace {

using Number = boost::multiprecision::cpp_bin_float_50;
static_assert(std::is_trivially_destructible_v<Number>);

/// Boost takes time and memory in proportion to the exponent, and reads more than decimals.
void check_decimal(std::string_view text) {
    constexpr std::size_t kMostCharacters = 1000, kMostDigitsOfExponent = 4;
    const auto digits = [&] {
        const std::size_t count = std::min(text.find_first_not_of("0123456789"), text.size());
        text.remove_prefix(count);
        return count;
    };
    const auto takes = [&](std::string_view some) {
        const bool is_there = !text.empty() && some.find(text.front()) != std::string_view::npos;
        if (is_there) text.remove_prefix(1);
        return is_there;
    };
    bool is_decimal = text.size() <= kMostCharacters;
    takes("+-");
    std::size_t count = digits();
    if (takes(".")) count += digits();
    if (takes("eE")) {
        takes("+-");
        const std::size_t exponent = digits();
        is_decimal = is_decimal && exponent >= 1 && exponent <= kMostDigitsOfExponent;
    }
    if (!is_decimal || count == 0 || !text.empty())
        throw std::runtime_error("not a decimal with an exponent of at most four digits");
}

}  // namespace

struct Real::Access {
    static_assert(sizeof(Number) <= sizeof(Real::storage_) && alignof(Number) <= alignof(Real));

    static const Number& of(const Real& a) {
        return *std::launder(reinterpret_cast<const Number*>(a.storage_));
    }
    static Number& of(Real& a) { return *std::launder(reinterpret_cast<Number*>(a.storage_)); }
    template <class T>
    static void create(Real& a, const T& value) {
        ::new (static_cast<void*>(a.storage_)) Number(value);
    }
    static Real make(const Number& value) {
        Real a;
        of(a) = value;
        return a;
    }
};

Real::Real(long long value) { Access::create(*this, value); }
Real::Real(double value) { Access::create(*this, value); }
Real::Real(const char* decimal) {
    check_decimal(decimal);
    Access::create(*this, decimal);
}
Real::Real(const Real& other) noexcept { Access::create(*this, Access::of(other)); }
Real& Real::operator=(const Real& other) noexcept {
    Access::of(*this) = Access::of(other);
    return *this;
}

Real::operator double() const { return static_cast<double>(Access::of(*this)); }
Real::operator int() const { return static_cast<int>(Access::of(*this)); }

std::string Real::str(int digits) const { return Access::of(*this).str(digits, std::ios_base::fmtflags{}); }

Real& Real::operator+=(const Real& other) {
    Access::of(*this) += Access::of(other);
    return *this;
}
Real& Real::operator-=(const Real& other) {
    Access::of(*this) -= Access::of(other);
    return *this;
}
Real& Real::operator*=(const Real& other) {
    Access::of(*this) *= Access::of(other);
    return *this;
}
Real& Real::operator/=(const Real& other) {
    Access::of(*this) /= Access::of(other);
    return *this;
}
Real Real::operator-() const { return Access::make(-Access::of(*this)); }

Real operator+(const Real& a, const Real& b) { return Real(a) += b; }
Real operator-(const Real& a, const Real& b) { return Real(a) -= b; }
Real operator*(const Real& a, const Real& b) { return Real(a) *= b; }
Real operator/(const Real& a, const Real& b) { return Real(a) /= b; }

bool operator==(const Real& a, const Real& b) { return Real::Access::of(a) == Real::Access::of(b); }
std::partial_ordering operator<=>(const Real& a, const Real& b) {
    const Number &x = Real::Access::of(a), &y = Real::Access::of(b);
    if (isnan(x) || isnan(y)) return std::partial_ordering::unordered;
    return x.compare(y) <=> 0;
}

Real abs(const Real& a) { return Real::Access::make(abs(Real::Access::of(a))); }
Real sqrt(const Real& a) { return Real::Access::make(sqrt(Real::Access::of(a))); }
Real sin(const Real& a) { return Real::Access::make(sin(Real::Access::of(a))); }
Real cos(const Real& a) { return Real::Access::make(cos(Real::Access::of(a))); }
Real acos(const Real& a) { return Real::Access::make(acos(Real::Access::of(a))); }
Real floor(const Real& a) { return Real::Access::make(floor(Real::Access::of(a))); }
Real round(const Real& a) { return Real::Access::make(round(Real::Access::of(a))); }
Real ldexp(const Real& a, int exponent) { return Real::Access::make(ldexp(Real::Access::of(a), exponent)); }
Real pow(const Real& a, int exponent) { return Real::Access::make(pow(Real::Access::of(a), exponent)); }

std::ostream& operator<<(std::ostream& stream, const Real& a) { return stream << Real::Access::of(a); }

const Real& pi() {
    static const Real value(Real::Access::make(boost::math::constants::pi<Number>()));
    return value;
}

}  // namespace zonal::exact
