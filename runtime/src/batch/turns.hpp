#pragma once

// What turns a pack of vectors: the generated kernels, at once or in two steps.

#include "order_kernels.hpp"
#include "rotations.hpp"

/// Everything that the function's body calls becomes part of it.
#if HWY_COMPILER_GCC || HWY_COMPILER_CLANG
#define ZONAL_FLATTEN __attribute__((flatten))
#else
#define ZONAL_FLATTEN
#endif

namespace zonal::batch {
namespace {

/// Bytes on the stack for the values of one step of a walk: with what kernels themselves take, a call stays
/// within what zonal/batch.hpp states.
constexpr std::size_t kMostBytes = 32768;

/// More than this much code is better called than repeated.
constexpr int kLargestInlined = 6;

template <class T, int N>
HWY_NOINLINE ZONAL_FLATTEN void rotate_called(const Pack<T>* R, Pack<T>* f) {
    AtOnce<N>::rotate(R, f);
}
template <class T, int N>
HWY_NOINLINE ZONAL_FLATTEN void prepare_called(const Pack<T>* R, Pack<T>* scalars) {
    PackKernels<N>::prepare(R, scalars);
}
/// No scalar is part of f: the compiler need not read them again after f is written.
template <class T, int N>
HWY_NOINLINE ZONAL_FLATTEN void apply_called(const Pack<T>* HWY_RESTRICT scalars, Pack<T>* HWY_RESTRICT f) {
    PackKernels<N>::apply(scalars, f);
}

/// What a rotation turns.
enum class Use { one_channel, channels, all_vectors };

/// Turns one channel of vectors, each by a rotation of its own: everything at once.
template <class T, int N>
class Once {
  public:
    static constexpr int kOrder = N;
    static constexpr Use kUse = Use::one_channel;

    /// Takes the rotations that load(R) writes.
    template <class Load>
    HWY_INLINE void take(RotationForm form, const Load& load) {
        load(R_);
        sign_.take_from(R_, form);
    }
    HWY_INLINE void operator()(Pack<T>* f) const {
        sign_.negate_odd_bands(f);
        if constexpr (N <= kLargestInlined)
            AtOnce<N>::rotate(R_, f);
        else
            rotate_called<T, N>(R_, f);
    }

  private:
    Pack<T> R_[9];
    Sign<T, N, !AtOnce<N>::kTakesMirrors> sign_;
};

/// The same in two steps: what depends on the rotations only is kept. For one channel that is faster than at
/// once where there are divisions: fewer values wait for them in registers.
template <class T, int N, Use kWhat>
class Prepared {
  public:
    static constexpr int kOrder = N;
    static constexpr Use kUse = kWhat;

    template <class Load>
    HWY_INLINE void take(RotationForm form, const Load& load) {
        Pack<T> R[9];
        load(R);
        sign_.take_from(R, form);
        if constexpr (N <= kLargestInlined && kUse != Use::all_vectors)
            PackKernels<N>::prepare(R, scalars_);
        else
            prepare_called<T, N>(R, scalars_);
    }
    HWY_INLINE void operator()(Pack<T>* f) const {
        sign_.negate_odd_bands(f);
        if constexpr (N <= kLargestInlined)
            PackKernels<N>::apply(scalars_, f);
        else
            apply_called<T, N>(scalars_, f);
    }

    /// Takes for every lane the rotation of one lane of others.
    template <Use kOthers>
    HWY_INLINE void broadcast(const Prepared<T, N, kOthers>& others, std::size_t lane) {
        sign_.broadcast(others.sign(), lane);
        for (int i = 0; i < kScalars; ++i) {
            T value;
            hwy::CopyBytes<sizeof(T)>(reinterpret_cast<const char*>(others.scalars() + i) + lane * sizeof(T),
                                      &value);
            scalars_[i].lanes = hn::Set(Tag<T>(), value);
        }
    }
    const auto& sign() const { return sign_; }
    const Pack<T>* scalars() const { return scalars_; }

    static constexpr int kScalars = PackKernels<N>::kScalars;

  private:
    Sign<T, N, !PackKernels<N>::kTakesMirrors> sign_;
    Pack<T> scalars_[kScalars];
};

/// Turns by rotations of their own, one channel: products only have nothing that is worth keeping; and of
/// what is called, one call is better than two.
template <class T, int N>
using OneEach = std::conditional_t<(AtOnce<N>::kTakesMirrors || N > kLargestInlined), Once<T, N>,
                                   Prepared<T, N, Use::one_channel>>;

/// The same, where the loop is not worth another copy of the kernel.
template <class Turn, class T>
HWY_NOINLINE ZONAL_FLATTEN void turn_called(const Turn& turn, Pack<T>* f) {
    turn(f);
}
template <class Turn, class T>
HWY_NOINLINE ZONAL_FLATTEN void take_called(Turn& turn, const Pack<T>* R, RotationForm form) {
    turn.take(form, [R](Pack<T>* to) {
        for (int i = 0; i < 9; ++i) to[i] = R[i];
    });
}

/// As turn_called, for coefficients in the order and scale of a convention.
template <class Turn, class T>
HWY_NOINLINE void turn_in_form(const CoefficientForm<T>& form, const Turn& turn, Pack<T>* f) {
    constexpr int kCount = Turn::kOrder * Turn::kOrder;
    if constexpr (kCount <= CoefficientForm<T>::kMost) {
        Pack<T> ours[kCount];
        for (int j = 0; j < kCount; ++j)
            ours[form.index[j]].lanes = hn::Mul(hn::Set(Tag<T>(), form.to_ours[j]), f[j].lanes);
        turn_called(turn, ours);
        for (int j = 0; j < kCount; ++j)
            f[j].lanes = hn::Mul(hn::Set(Tag<T>(), form.from_ours[j]), ours[form.index[j]].lanes);
    }
}

template <class Turn, class T>
struct InForm {
    const CoefficientForm<T>& form;
    const Turn& turn;
    HWY_INLINE void operator()(Pack<T>* f) const { turn_in_form(form, turn, f); }
};

/// Turns f, whose coefficients are as the job has them, by a copy of the kernel that others share.
template <class Turn, class T>
HWY_INLINE void turn_shared(const Job<T>& job, const Turn& turn, Pack<T>* f) {
    if (HWY_UNLIKELY(job.coefficient_form != nullptr))
        turn_in_form(*job.coefficient_form, turn, f);
    else
        turn_called(turn, f);
}

}  // namespace
}  // namespace zonal::batch
