#pragma once

namespace zonal {

/// A signal value of three floats, as a program has one of its own: it shares nothing with zonal/rgb.hpp.
/// Never inlined: kernels of thousands of lines compile sooner so.
struct Channels {
    using value_type = float;
    float c[3];

    [[gnu::noinline]] friend Channels operator+(Channels a, Channels b) {
        return {{a.c[0] + b.c[0], a.c[1] + b.c[1], a.c[2] + b.c[2]}};
    }
    [[gnu::noinline]] friend Channels operator-(Channels a, Channels b) {
        return {{a.c[0] - b.c[0], a.c[1] - b.c[1], a.c[2] - b.c[2]}};
    }
    [[gnu::noinline]] friend Channels operator-(Channels a) { return {{-a.c[0], -a.c[1], -a.c[2]}}; }
    [[gnu::noinline]] friend Channels operator*(float s, Channels a) {
        return {{s * a.c[0], s * a.c[1], s * a.c[2]}};
    }
    /// By one rounding: published bounds are those of fused instructions.
    [[gnu::noinline]] friend Channels fma(float s, Channels a, Channels b) {
        return {{__builtin_fmaf(s, a.c[0], b.c[0]), __builtin_fmaf(s, a.c[1], b.c[1]),
                 __builtin_fmaf(s, a.c[2], b.c[2])}};
    }
};

}  // namespace zonal
