#pragma once

// Arithmetic beside fused instructions that kernels run in (graph/evaluate.hpp). Compile with
// -ffp-contract=off.

#include <bit>
#include <cmath>
#include <cstdint>

#include "graph/evaluate.hpp"

namespace zonal::arithmetic {

/// Products and sums, each rounded.
struct Apart : graph::Fused {
    template <class T>
    static T fma(T a, T b, T c) {
        const T product = a * b;
        return product + c;
    }
};

/// What Vulkan and GLSL allow in float beside that ("Precision and Operation of SPIR-V Instructions"):
/// quotients off by 2.5 ulp, and roots, which are 1 / inversesqrt(x), by the 2 ulp of that and those of the
/// division. Off by all of it, up or down as the bits of the result say, so that runs repeat.
template <class Base>
struct Allowed : Base {
    static float divide(float a, float b) { return off_by(a / b, 2.5f); }
    static float square_root(float a) { return off_by(std::sqrt(a), 4.5f); }

  private:
    static float off_by(float exact, float ulps) {
        constexpr float kUlp = 0x1p-23f;
        const auto bits = std::bit_cast<std::uint32_t>(exact) * 0x9e3779b9u;
        return exact * (1 + ((bits >> 31) != 0 ? ulps : -ulps) * kUlp);
    }
};

}  // namespace zonal::arithmetic
