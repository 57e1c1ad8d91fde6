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

/// A signal value of three counting channels.
struct CountingRgb {
    using value_type = Counting;
    Counting c[3];

    [[gnu::noinline]] friend CountingRgb operator+(const CountingRgb& a, const CountingRgb& b) {
        return {{a.c[0] + b.c[0], a.c[1] + b.c[1], a.c[2] + b.c[2]}};
    }
    [[gnu::noinline]] friend CountingRgb operator-(const CountingRgb& a, const CountingRgb& b) {
        return {{a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2]}};
    }
    [[gnu::noinline]] friend CountingRgb operator-(const CountingRgb& a) {
        return {{-a.c[0], -a.c[1], -a.c[2]}};
    }
    [[gnu::noinline]] friend CountingRgb operator*(Counting s, const CountingRgb& a) {
        return {{s * a.c[0], s * a.c[1], s * a.c[2]}};
    }
    [[gnu::noinline]] friend CountingRgb fma(Counting s, const CountingRgb& a, const CountingRgb& b) {
        return {{fma(s, a.c[0], b.c[0]), fma(s, a.c[1], b.c[1]), fma(s, a.c[2], b.c[2])}};
    }
};

/// A signal value that counts what is done with it; its scalars are doubles and are not counted.
struct CountingSignal {
    static inline Tally tally;

    friend CountingSignal operator+(CountingSignal, CountingSignal) { return ++tally.add, CountingSignal{}; }
    friend CountingSignal operator-(CountingSignal, CountingSignal) { return ++tally.add, CountingSignal{}; }
    friend CountingSignal operator-(CountingSignal) { return {}; }
    friend CountingSignal operator*(double, CountingSignal) { return ++tally.mul, CountingSignal{}; }
    friend CountingSignal fma(double, CountingSignal, CountingSignal) {
        return ++tally.fma, CountingSignal{};
    }
};

}  // namespace zonal
