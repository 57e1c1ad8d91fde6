#pragma once

// A pack: one value of as many vectors as a register holds. It has the operations that generated kernels use.
// Included only by kernels.cpp, once for each instruction set; hence the unnamed namespaces here and in the
// headers beside it: nothing compiled for a wider instruction set may be seen by the linker elsewhere.
// Known limit: registers whose size is known at compile time only (no SVE, no RVV).

#include <hwy/highway.h>

#include <cstddef>

/// AVX-512 and what extends it: Highway's better targets have lower numbers, and those of x86 the lowest.
#define ZONAL_PACKS_ARE_AVX512 (HWY_TARGET <= HWY_AVX3)

namespace zonal::batch {
namespace {

namespace hn = hwy::HWY_NAMESPACE;

template <class T>
using Tag = hn::ScalableTag<T>;

template <class T>
using Lanes = hn::Vec<Tag<T>>;

template <class T>
inline constexpr std::size_t kLanes = hn::MaxLanes(Tag<T>());

template <class T>
class Pack {
  public:
    using value_type = T;

    Pack() = default;
    explicit HWY_INLINE Pack(Lanes<T> values) : lanes(values) {}
    explicit HWY_INLINE Pack(int value) : lanes(hn::Set(Tag<T>(), static_cast<T>(value))) {}
    explicit HWY_INLINE Pack(float value) : lanes(hn::Set(Tag<T>(), static_cast<T>(value))) {}
    explicit HWY_INLINE Pack(double value) : lanes(hn::Set(Tag<T>(), static_cast<T>(value))) {}

    friend HWY_INLINE Pack operator+(Pack a, Pack b) { return Pack(hn::Add(a.lanes, b.lanes)); }
    friend HWY_INLINE Pack operator-(Pack a, Pack b) { return Pack(hn::Sub(a.lanes, b.lanes)); }
    friend HWY_INLINE Pack operator*(Pack a, Pack b) { return Pack(hn::Mul(a.lanes, b.lanes)); }
    friend HWY_INLINE Pack operator/(Pack a, Pack b) { return Pack(hn::Div(a.lanes, b.lanes)); }
    friend HWY_INLINE Pack operator-(Pack a) {
#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128  // lanes that are no vector of the compiler
        return Pack(hn::Neg(a.lanes));
#else
        // The compiler merges this minus into a multiply-add, but not the exclusive or of hn::Neg.
        return Pack(Lanes<T>{-a.lanes.raw});
#endif
    }
    friend HWY_INLINE Pack fma(Pack a, Pack b, Pack c) { return Pack(hn::MulAdd(a.lanes, b.lanes, c.lanes)); }
    friend HWY_INLINE Pack sqrt(Pack a) { return Pack(hn::Sqrt(a.lanes)); }
    friend HWY_INLINE Pack copysign(Pack a, Pack b) { return Pack(hn::CopySign(a.lanes, b.lanes)); }

    Lanes<T> lanes;
};

}  // namespace
}  // namespace zonal::batch
