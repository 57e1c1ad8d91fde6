#pragma once

#include <cmath>

namespace zonal {

struct Tally {
    int mul = 0, add = 0, fma = 0, other = 0;
};

/// A number that counts the operations done with it. A minus sign alone is none (see graph/counts.hpp). Never
/// inlined: kernels of thousands of lines compile sooner so.
struct Counting {
    double value = 0;

    static inline Tally tally;

    Counting() = default;
    explicit Counting(double v) : value(v) {}

    [[gnu::noinline]] friend Counting operator+(Counting a, Counting b) {
        return ++tally.add, Counting(a.value + b.value);
    }
    [[gnu::noinline]] friend Counting operator-(Counting a, Counting b) {
        return ++tally.add, Counting(a.value - b.value);
    }
    [[gnu::noinline]] friend Counting operator*(Counting a, Counting b) {
        return ++tally.mul, Counting(a.value * b.value);
    }
    [[gnu::noinline]] friend Counting operator/(Counting a, Counting b) {
        return ++tally.other, Counting(a.value / b.value);
    }
    [[gnu::noinline]] friend Counting operator-(Counting a) { return Counting(-a.value); }
    [[gnu::noinline]] friend Counting fma(Counting a, Counting b, Counting c) {
        return ++tally.fma, Counting(a.value * b.value + c.value);
    }
    [[gnu::noinline]] friend Counting sqrt(Counting a) { return ++tally.other, Counting(std::sqrt(a.value)); }
    friend Counting copysign(Counting a, Counting b) { return Counting(std::copysign(a.value, b.value)); }
};

}  // namespace zonal
