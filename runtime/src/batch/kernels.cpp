// Batches on packs, for one instruction set and one type: CMake compiles this file once for each, with
// ZONAL_BATCH_SCALAR (float or double) and ZONAL_BATCH_ENTRY (the name of the table defined at the end).
// Method: read as many vectors and rotations as a pack has lanes, transposed in registers; run the generated
// kernel on packs, in place; write back. What is left at the end, and layouts that blocks of 16 bytes do not
// fit, go through a copy on the stack with the same kernel.
// Only Highway, the generated headers and plain headers of this folder may be included here: any inline
// function of the standard library could be the copy that the linker keeps for every processor.

#define HWY_COMPILE_ONLY_STATIC
#include "job.hpp"
#include "order_kernels.hpp"
#include "pack.hpp"
#include "stream.hpp"
#include "transpose.hpp"

namespace zonal::batch {
namespace {

using T = ZONAL_BATCH_SCALAR;
using P = Pack<T>;

constexpr std::size_t kWidth = kLanes<T>;

/// From this order on a kernel needs determinant +1: a mirror is a rotation by -R with odd bands negated.
constexpr int kFirstProperOrder = 4;

/// Interleaved channels are transposed together up to this number, one by one through copies above.
constexpr std::size_t kMostInterleaved = 4;

/// More than this much code is better called than repeated.
constexpr int kLargestInlined = 4;

/// Where nine values of kWidth rotations come from.
struct Rotations {
    const T* values;
    std::size_t stride;
};

HWY_INLINE void load_rotations(RotationForm form, Rotations from, P* R) {
    if (form == RotationForm::matrix) return read_columns<9>(from.values, from.stride, R);
    P q[4];
    read_columns<4>(from.values, from.stride, q);
    const P x2 = q[0] + q[0], y2 = q[1] + q[1], z2 = q[2] + q[2];
    const P xx = x2 * q[0], xy = x2 * q[1], xz = x2 * q[2], xw = x2 * q[3];
    const P yy = y2 * q[1], yz = y2 * q[2], yw = y2 * q[3];
    const P zz = z2 * q[2], zw = z2 * q[3];
    const P one(1.0);
    R[0] = one - (yy + zz);
    R[1] = xy - zw;
    R[2] = xz + yw;
    R[3] = xy + zw;
    R[4] = one - (xx + zz);
    R[5] = yz - xw;
    R[6] = xz - yw;
    R[7] = yz + xw;
    R[8] = one - (xx + yy);
}

/// Rotations made proper: R times the sign of its determinant, and that sign. The sign of a NaN is +1.
template <int N>
class Proper {
  public:
    HWY_INLINE void load(RotationForm form, Rotations from) {
        load_rotations(form, from, R);
        if constexpr (N >= kFirstProperOrder) {
            const P determinant = R[0] * fma(R[4], R[8], -(R[5] * R[7])) +
                                  R[1] * fma(R[5], R[6], -(R[3] * R[8])) +
                                  R[2] * fma(R[3], R[7], -(R[4] * R[6]));
            const auto is_mirror = hn::Lt(determinant.lanes, hn::Zero(Tag<T>()));
            has_mirror_ = !hn::AllFalse(Tag<T>(), is_mirror);
            if (HWY_UNLIKELY(has_mirror_)) {
                const P one(1.0);
                sign_.lanes = hn::IfThenElse(is_mirror, (-one).lanes, one.lanes);
                for (P& value : R) value = sign_ * value;
            }
        }
    }

    /// The kernel is linear: negating odd bands before it is as good as after.
    HWY_INLINE void negate_odd_bands(P* f) const {
        if constexpr (N >= kFirstProperOrder) {
            if (HWY_LIKELY(!has_mirror_)) return;
            for (int l = 1; l < N; l += 2)
                for (int i = l * l; i < (l + 1) * (l + 1); ++i) f[i] = sign_ * f[i];
        }
    }

    P R[9];

  private:
    P sign_;
    bool has_mirror_ = false;
};

template <int N>
HWY_INLINE void rotate_inline(const P* R, P* f) {
    OrderKernels<N>::rotate_pack(R, f);
}
template <int N>
HWY_NOINLINE void rotate_called(const P* R, P* f) {
    OrderKernels<N>::rotate_pack(R, f);
}
template <int N>
HWY_NOINLINE void prepare(const P* R, P* scalars) {
    OrderKernels<N>::prepare_pack(R, scalars);
}
template <int N>
HWY_NOINLINE void apply(const P* scalars, P* f) {
    OrderKernels<N>::apply_pack(scalars, f);
}

/// Turns one channel of kWidth vectors: everything at once.
template <int N>
class Once {
  public:
    HWY_INLINE void load(RotationForm form, Rotations from) { proper_.load(form, from); }
    HWY_INLINE void operator()(P* f) const {
        proper_.negate_odd_bands(f);
        if constexpr (N <= kLargestInlined)
            rotate_inline<N>(proper_.R, f);
        else
            rotate_called<N>(proper_.R, f);
    }

  private:
    Proper<N> proper_;
};

/// The same for many channels or vectors of the same rotations.
template <int N>
class Prepared {
  public:
    HWY_INLINE void load(RotationForm form, Rotations from) {
        proper_.load(form, from);
        prepare<N>(proper_.R, scalars_);
    }
    HWY_INLINE void operator()(P* f) const {
        proper_.negate_odd_bands(f);
        apply<N>(scalars_, f);
    }

  private:
    Proper<N> proper_;
    P scalars_[OrderKernels<N>::kCount];
};

/// A batch of order N, seen kWidth vectors at a time. kFirst: 1 where band 0 is apart, else 0.
template <int N, int kFirst>
class Batch {
  public:
    explicit Batch(const Job<T>& job) : job_(job) {
        if (!job.is_interleaved || job.channels > kMostInterleaved) return;
        for (std::size_t column = 0; column < kColumns * job.channels; ++column)
            slots_[column] = static_cast<unsigned short>(column % job.channels * kCoefficients + kFirst +
                                                         column / job.channels);
    }

    /// load(turn, k, live): sets `turn` to rotations k ... k + live - 1.
    template <class Turn, class Load>
    HWY_INLINE void run(Turn& turn, const Load& load) {
        if (job_.is_streamed) {
            Stream<T, kWidth * kColumns * kMostInterleaved> stream(job_.out);
            const std::size_t length = kColumns * job_.channels;
            const std::size_t done = whole_packs(turn, load, [&](const T* in, std::size_t) {
                turn_rows(turn, in, stream.room(), length);
                stream.advance(kWidth * length);
            });
            stream.finish();
            rest(turn, load, done);
        } else {
            const std::size_t done = whole_packs(turn, load, [&](const T* in, std::size_t offset) {
                turn_rows(turn, in, job_.out + offset, job_.stride);
            });
            rest(turn, load, done);
        }
    }

    /// Streaming needs rows that are turned without copies, and few enough channels to stage them.
    static bool can_stream(const Job<T>& job) {
        return !needs_copies(job) && job.channels <= kMostInterleaved;
    }

  private:
    static constexpr std::size_t kCoefficients = static_cast<std::size_t>(N) * N;
    static constexpr std::size_t kColumns = kCoefficients - kFirst;  ///< of one channel in memory

    static bool needs_copies(const Job<T>& job) {
        return kColumns < kBlock<T> || (job.is_interleaved && job.channels > kMostInterleaved);
    }

    template <class Turn, class Load, class Rows>
    HWY_INLINE std::size_t whole_packs(Turn& turn, const Load& load, const Rows& rows) {
        if (needs_copies(job_)) return 0;
        std::size_t k = 0;
        for (; k + kWidth <= job_.count; k += kWidth) {
            load(turn, k, kWidth);
            rows(job_.in + k * job_.stride, k * job_.stride);
        }
        return k;
    }

    template <class Turn, class Load>
    HWY_NOINLINE void rest(Turn& turn, const Load& load, std::size_t k) {
        for (; k < job_.count; k += kWidth) {
            const std::size_t live = job_.count - k < kWidth ? job_.count - k : kWidth;
            load(turn, k, live);
            const std::size_t step = job_.is_interleaved ? job_.channels : 1;
            for (std::size_t channel = 0; channel < job_.channels; ++channel) {
                const std::size_t offset = k * job_.stride + channel * (job_.is_interleaved ? 1 : kColumns);
                turn_copies(turn, job_.in + offset, job_.out + offset, step, live);
            }
        }
    }

    template <class Turn>
    HWY_INLINE void turn_rows(const Turn& turn, const T* in, T* out, std::size_t out_stride) const {
        if (job_.is_interleaved) return turn_interleaved(turn, in, out, out_stride);
        for (std::size_t channel = 0; channel < job_.channels; ++channel)
            turn_channel(turn, in + channel * kColumns, job_.stride, out + channel * kColumns, out_stride);
    }

    template <class Turn>
    HWY_INLINE void turn_channel(const Turn& turn, const T* in, std::size_t in_stride, T* out,
                                 std::size_t out_stride) const {
        P f[kCoefficients];
        if constexpr (kFirst == 1) f[0].lanes = hn::Zero(Tag<T>());
        read_columns<kColumns>(in, in_stride, f + kFirst);
        turn(f);
        write_columns<kColumns>(f + kFirst, out, out_stride);
    }

    template <class Turn>
    HWY_NOINLINE void turn_interleaved(const Turn& turn, const T* in, T* out, std::size_t out_stride) const {
        P f[kCoefficients * kMostInterleaved];
        const std::size_t columns = kColumns * job_.channels;
        read_slots(in, job_.stride, slots_, columns, f);
        for (std::size_t channel = 0; channel < job_.channels; ++channel) {
            if constexpr (kFirst == 1) f[channel * kCoefficients].lanes = hn::Zero(Tag<T>());
            turn(f + channel * kCoefficients);
        }
        write_slots(f, slots_, columns, out, out_stride);
    }

    /// One channel of `live` vectors, coefficients `step` apart, by way of the stack.
    template <class Turn>
    HWY_NOINLINE void turn_copies(const Turn& turn, const T* in, T* out, std::size_t step,
                                  std::size_t live) const {
        constexpr std::size_t kLength = kRowLength<T, kColumns>;
        HWY_ALIGN T rows[kWidth * kLength];
        for (std::size_t k = 0; k < kWidth; ++k)
            for (std::size_t i = 0; i < kLength; ++i)
                rows[k * kLength + i] = k < live && i < kColumns ? in[k * job_.stride + i * step] : T(0);
        turn_channel(turn, rows, kLength, rows, kLength);
        for (std::size_t k = 0; k < live; ++k)
            for (std::size_t i = 0; i < kColumns; ++i)
                out[k * job_.stride + i * step] = rows[k * kLength + i];
    }

    const Job<T>& job_;
    unsigned short slots_[kColumns * kMostInterleaved + 1];  ///< of interleaved columns, see read_slots
};

/// Rotations k ... k + live - 1 of the job; the lanes beyond get the identity.
template <class Turn>
HWY_INLINE void load_own(const Job<T>& job, Turn& turn, std::size_t k, std::size_t live) {
    const T* values = job.rotations + k * job.rotation_stride;
    if (HWY_LIKELY(live == kWidth)) return turn.load(job.form, {values, job.rotation_stride});
    const std::size_t length = job.form == RotationForm::matrix ? 9 : 4;
    HWY_ALIGN T rows[kWidth * 9];
    for (std::size_t row = 0; row < kWidth; ++row) {
        for (std::size_t i = 0; i < length; ++i) {
            const bool is_one = length == 9 ? i % 4 == 0 : i == 3;
            rows[row * length + i] = row < live ? values[row * job.rotation_stride + i] : T(is_one);
        }
    }
    turn.load(job.form, {rows, length});
}

template <int N, int kFirst>
void each(const Job<T>& job) {
    Batch<N, kFirst> batch(job);
    const auto load = [&job](auto& turn, std::size_t k, std::size_t live) { load_own(job, turn, k, live); };
    if (job.channels == 1) {
        Once<N> turn;
        batch.run(turn, load);
    } else {
        Prepared<N> turn;
        batch.run(turn, load);
    }
}

template <int N, int kFirst>
void all(const Job<T>& job) {
    Prepared<N> turn;
    turn.load(job.form, {job.rotations, 0});  // stride 0: the same in every lane
    Batch<N, kFirst>(job).run(turn, [](auto&, std::size_t, std::size_t) {});
}

template <int N>
void each(const Job<T>& job) {
    job.is_dc_apart ? each<N, 1>(job) : each<N, 0>(job);
}

template <int N>
void all(const Job<T>& job) {
    job.is_dc_apart ? all<N, 1>(job) : all<N, 0>(job);
}

#define ZONAL_BATCH_KERNEL(N) {N, each<N>, all<N>},
constexpr Kernel<T> kKernels[] = {ZONAL_FOR_EACH_ORDER(ZONAL_BATCH_KERNEL)};
#undef ZONAL_BATCH_KERNEL

}  // namespace

KernelTable<T> ZONAL_BATCH_ENTRY();
KernelTable<T> ZONAL_BATCH_ENTRY() {
    return {kKernels, static_cast<int>(sizeof kKernels / sizeof kKernels[0])};
}

}  // namespace zonal::batch
