// Batches on packs, for one instruction set and one type: CMake compiles this file once for each, with
// ZONAL_BATCH_SCALAR (float or double) and ZONAL_BATCH_ENTRY (the name of the table defined at the end).
// Method: read as many vectors and rotations as a pack has lanes, transposed in registers; run the generated
// kernel on packs, in place; write back. What is left at the end, and layouts that blocks of 16 bytes do not
// fit, go through a copy on the stack with the same kernel. Three channels by one rotation need no
// transposition (three_channels.hpp).
// Only Highway, the generated headers and plain headers of this folder may be included here: any inline
// function of the standard library could be the copy that the linker keeps for every processor.

#define HWY_COMPILE_ONLY_STATIC
#include <type_traits>

#include "job.hpp"
#include "order_kernels.hpp"
#include "pack.hpp"
#include "stream.hpp"
#include "three_channels.hpp"
#include "transpose.hpp"

/// Everything that the function's body calls becomes part of it.
#if HWY_COMPILER_GCC || HWY_COMPILER_CLANG
#define ZONAL_FLATTEN __attribute__((flatten))
#else
#define ZONAL_FLATTEN
#endif

namespace zonal::batch {
namespace {

using T = ZONAL_BATCH_SCALAR;
using P = Pack<T>;

constexpr std::size_t kWidth = kLanes<T>;

/// Interleaved channels are transposed together up to this number, one by one through copies above.
constexpr std::size_t kMostInterleaved = 4;

/// Streaming stages this many channels at most.
constexpr std::size_t kMostStreamed = 4;

/// Whether the loops are also compiled for the most common layouts. Not for the narrow instruction sets of
/// x86, which serve old processors: compiling them takes long enough as it is.
constexpr bool kHasCommonLayouts = !HWY_ARCH_X86 || HWY_TARGET <= HWY_AVX2;

/// More than this much code is better called than repeated.
constexpr int kLargestInlined = 6;

/// Bytes ahead of the vectors in work that are fetched into the first cache, and farther ahead into the
/// second, where batches are larger than the caches: the first cache alone does not have enough lines under
/// way to hide memory.
constexpr std::size_t kNear = 4096;
constexpr std::size_t kFar = 32768;

/// Fetches cache lines ahead of `length` values.
HWY_INLINE void fetch_ahead(const T* values, std::size_t length) {
    const char* bytes = reinterpret_cast<const char*>(values);
    for (std::size_t i = 0; i < length * sizeof(T); i += 64) {
        hwy::Prefetch(bytes + kNear + i);
#if HWY_COMPILER_GCC || HWY_COMPILER_CLANG
        __builtin_prefetch(bytes + kFar + i, 0, 2);
#endif
    }
}

/// Rotation `form` of kWidth rows as matrices.
template <RotationForm kForm>
HWY_INLINE void load_rotations(const T* rows, std::size_t stride, P* R) {
    if constexpr (kForm == RotationForm::matrix) {
        read_columns<9>(rows, stride, R);
    } else {
        P q[4];
        read_columns<4>(rows, stride, q);
        const P x2 = q[0] + q[0], y2 = q[1] + q[1], z2 = q[2] + q[2];
        const P xx = x2 * q[0], xy = x2 * q[1], xz = x2 * q[2], xw = x2 * q[3];
        const P yy = y2 * q[1], yz = y2 * q[2], yw = y2 * q[3];
        const P zz = z2 * q[2], zw = z2 * q[3];
        const P one(1);
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
}

/// What makes rotations proper, where the kernel needs them so: the sign of each determinant, +1 for a NaN. A
/// mirror is a rotation by -R with odd bands negated.
template <int N, bool kMayMirror>
class Sign {
  public:
    /// Multiplies R by the signs.
    HWY_INLINE void take_from(P* R) {
        if constexpr (kMayMirror) {
            const P determinant =
                R[0] * fma(R[4], R[8], -(R[5] * R[7])) +
                (R[1] * fma(R[5], R[6], -(R[3] * R[8])) + R[2] * fma(R[3], R[7], -(R[4] * R[6])));
            const auto is_mirror = hn::Lt(determinant.lanes, hn::Zero(Tag<T>()));
            has_mirror_ = !hn::AllFalse(Tag<T>(), is_mirror);
            sign_.lanes = hn::IfThenElse(is_mirror, P(-1).lanes, P(1).lanes);
            if (HWY_LIKELY(!has_mirror_)) return;
            for (int i = 0; i < 9; ++i) R[i] = sign_ * R[i];
        }
    }

    /// The kernel is linear: negating odd bands before it is as good as after.
    HWY_INLINE void negate_odd_bands(P* f) const {
        if constexpr (kMayMirror) {
            if (HWY_LIKELY(!has_mirror_)) return;
            for (int l = 1; l < N; l += 2)
                for (int i = l * l; i < (l + 1) * (l + 1); ++i) f[i] = sign_ * f[i];
        }
    }

  private:
    P sign_;
    bool has_mirror_ = false;
};

template <int N>
HWY_NOINLINE ZONAL_FLATTEN void rotate_called(const P* R, P* f) {
    AtOnce<N>::rotate(R, f);
}
template <int N>
HWY_NOINLINE ZONAL_FLATTEN void prepare_called(const P* R, P* scalars) {
    PackKernels<N>::prepare(R, scalars);
}
/// No scalar is part of f: the compiler need not read them again after f is written.
template <int N>
HWY_NOINLINE ZONAL_FLATTEN void apply_called(const P* HWY_RESTRICT scalars, P* HWY_RESTRICT f) {
    PackKernels<N>::apply(scalars, f);
}

/// What a rotation turns.
enum class Use { one_channel, channels, all_vectors };

/// Turns one channel of kWidth vectors, each by a rotation of its own: everything at once.
template <int N, RotationForm kForm>
class Once {
  public:
    static constexpr Use kUse = Use::one_channel;
    static constexpr std::size_t kRotationLength = kForm == RotationForm::matrix ? 9 : 4;

    HWY_INLINE void load(const T* rows, std::size_t stride) {
        load_rotations<kForm>(rows, stride, R_);
        sign_.take_from(R_);
    }
    HWY_INLINE void operator()(P* f) const {
        sign_.negate_odd_bands(f);
        if constexpr (N <= kLargestInlined)
            AtOnce<N>::rotate(R_, f);
        else
            rotate_called<N>(R_, f);
    }

  private:
    P R_[9];
    Sign<N, !AtOnce<N>::kTakesMirrors && kForm == RotationForm::matrix> sign_;
};

/// The same in two steps: what depends on the rotations only is kept. For one channel that is faster than at
/// once where there are divisions: fewer values wait for them in registers.
template <int N, RotationForm kForm, Use kWhat>
class Prepared {
  public:
    static constexpr Use kUse = kWhat;
    static constexpr std::size_t kRotationLength = kForm == RotationForm::matrix ? 9 : 4;

    HWY_INLINE void load(const T* rows, std::size_t stride) {
        P R[9];
        load_rotations<kForm>(rows, stride, R);
        sign_.take_from(R);
        if constexpr (N <= kLargestInlined && kUse != Use::all_vectors)
            PackKernels<N>::prepare(R, scalars_);
        else
            prepare_called<N>(R, scalars_);
    }
    HWY_INLINE void operator()(P* f) const {
        sign_.negate_odd_bands(f);
        if constexpr (N <= kLargestInlined)
            PackKernels<N>::apply(scalars_, f);
        else
            apply_called<N>(scalars_, f);
    }

  private:
    Sign<N, !PackKernels<N>::kTakesMirrors && kForm == RotationForm::matrix> sign_;
    P scalars_[PackKernels<N>::kScalars];
};

/// A batch of order N, turned kWidth vectors at a time. kFirst: 1 where band 0 is apart, else 0.
template <int N, int kFirst, class Turn>
class Batch {
  public:
    explicit Batch(const Job<T>& job) : job_(job) {
        if (!job.is_interleaved || needs_copies()) return;
        for (std::size_t column = 0; column < kColumns * job.channels; ++column)
            slots_[column] = static_cast<unsigned short>(column % job.channels * kCoefficients + kFirst +
                                                         column / job.channels);
    }

    void run(RotationForm form, Turn& turn) { turn_rest(form, turn, needs_copies() ? 0 : turn_packs(turn)); }

  private:
    static constexpr std::size_t kCoefficients = static_cast<std::size_t>(N) * N;
    static constexpr std::size_t kColumns = kCoefficients - kFirst;  ///< of one channel in memory

    static constexpr bool kHasOwn = Turn::kUse != Use::all_vectors;  ///< rotations, for each vector one

    using Writer = Stream<T, kWidth * kColumns * kMostStreamed>;

    bool needs_copies() const {
        return kColumns < kBlock<T> || (job_.is_interleaved && job_.channels > kMostInterleaved);
    }

    /// What goes on between transpositions of kBlock columns: nothing in batches that fit the caches ...
    struct Small {
        HWY_INLINE Small(const Job<T>&, const T*, Writer*) {}
        HWY_INLINE void read() {}
        HWY_INLINE void write() {}
    };

    /// ... and reading ahead and writing what waits, as fast as columns are read and written, in others.
    class Large {
      public:
        HWY_INLINE Large(const Job<T>& job, const T* in, Writer* writer)
            : in_(job.is_large ? in : nullptr), writer_(writer) {}

        HWY_INLINE void read() {
            if (in_ == nullptr) return;
            fetch_ahead(in_, kStep);
            in_ += kStep;
            write();
        }
        HWY_INLINE void write() {
            if (HWY_LIKELY(writer_ != nullptr)) writer_->template write_some<kPace>();
        }

      private:
        static constexpr std::size_t kBlocks = kColumns < kBlock<T> ? 1 : kColumns / kBlock<T>;
        /// Values fetched ahead for each whole block of columns: together those of a pack of one channel.
        static constexpr std::size_t kStep = (kWidth * kColumns + kBlocks - 1) / kBlocks;

        /// Half of the lines of kBlock columns: as many are written while reading as while writing.
        static constexpr std::size_t kLine = Writer::kLineBytes / sizeof(T);
        static constexpr std::size_t kPace = kWidth * kBlock<T> < 2 * kLine ? kLine : kWidth * kBlock<T> / 2;

        const T* in_;
        Writer* writer_;
    };

    /// All whole packs; returns the number of vectors turned.
    std::size_t turn_packs(Turn& turn) const {
        if (job_.is_streamed && job_.channels <= kMostStreamed) {
            Writer writer(job_.out);
            const std::size_t done = turn_rows(turn, &writer);
            writer.finish();
            return done;
        }
        return turn_rows(turn, nullptr);
    }

    /// Copies of the loop for what is most common; constant addresses pay where the kernel is part of the
    /// loop.
    std::size_t turn_rows(Turn& turn, Writer* writer) const {
        if constexpr (kHasCommonLayouts && kFirst == 0 && Turn::kUse != Use::channels) {
            const bool is_touching =
                job_.stride == kColumns && (!kHasOwn || job_.rotation_stride == Turn::kRotationLength);
            if constexpr (kMayTouchNine<kColumns>) {
                if (is_touching && job_.is_large) return turn_nine<Large>(turn, writer);
                if (is_touching) return turn_nine<Small>(turn, writer);
            } else if constexpr (N <= kLargestInlined) {
                if (is_touching && job_.is_large) return turn_rows<Large, true>(turn, writer);
                if (is_touching) return turn_rows<Small, true>(turn, writer);
            } else {
                if (is_touching && !job_.is_large) return turn_rows<Small, false>(turn, writer);
            }
        }
        return turn_rows<Large, false>(turn, writer);
    }

    /// kIsTouching: vectors of one channel and rotations lie without gaps, so that addresses are constants.
    template <class Flow, bool kIsTouching>
    HWY_NOINLINE ZONAL_FLATTEN std::size_t turn_rows(Turn& turn, Writer* writer) const {
        const std::size_t stride = kIsTouching ? kColumns : job_.stride;
        const std::size_t rotation_stride = kIsTouching ? Turn::kRotationLength : job_.rotation_stride;
        const T* in = job_.in;
        const T* rotations = job_.rotations;
        T* out = job_.out;
        std::size_t k = 0;
        for (; k + kWidth <= job_.count; k += kWidth) {
            T* const to = writer != nullptr ? writer->room() : out;
            if constexpr (Turn::kUse == Use::one_channel) {
                Turn local;  // one of its own in every round stays in registers
                local.load(rotations, rotation_stride);
                turn_row(local, in, to, stride, Flow(job_, in, writer));
            } else if constexpr (Turn::kUse == Use::channels) {
                turn.load(rotations, rotation_stride);
                turn_channels(turn, in, to, Flow(job_, in, writer));
            } else if (kIsTouching || HWY_LIKELY(job_.channels == 1)) {
                turn_row(turn, in, to, stride, Flow(job_, in, writer));
            } else {
                turn_channels(turn, in, to, Flow(job_, in, writer));
            }
            if constexpr (kHasOwn) {
                if (job_.is_large) fetch_ahead(rotations, kWidth * rotation_stride);
                rotations += kWidth * rotation_stride;
            }
            if (writer != nullptr) writer->advance(kWidth * stride);
            in += kWidth * stride;
            out += kWidth * stride;
        }
        return k;
    }

    /// Order 3 where everything touches: a pack is written after the next one is read. The kernel is short,
    /// and most of its operations wait for one another; reading and writing side by side fill the time.
    /// Kernels of higher orders fill it by themselves, and would keep what waits outside of registers.
    template <class Flow>
    HWY_NOINLINE ZONAL_FLATTEN std::size_t turn_nine(Turn& turn, Writer* writer) const {
        const T* in = job_.in;
        const T* rotations = job_.rotations;
        T* out = job_.out;
        P turned[kColumns];
        const auto write = [&](Flow& flow) {
            T* const to = writer != nullptr ? writer->room() : out;
            write_columns<kColumns>(turned, to, kColumns, [&] { flow.write(); });
            if (writer != nullptr) writer->advance(kWidth * kColumns);
            out += kWidth * kColumns;
        };
        const auto turn_next = [&](const auto& after_reading) {
            Flow flow(job_, in, writer);
            Turn own;
            if constexpr (kHasOwn) {
                own.load(rotations, Turn::kRotationLength);
                if (job_.is_large) fetch_ahead(rotations, kWidth * Turn::kRotationLength);
                rotations += kWidth * Turn::kRotationLength;
            }
            P f[kColumns];
            read_columns<kColumns>(in, kColumns, f, [&] { flow.read(); });
            in += kWidth * kColumns;
            after_reading(flow);
            (kHasOwn ? own : turn)(f);
            for (std::size_t c = 0; c < kColumns; ++c) turned[c] = f[c];
        };
        if (job_.count < kWidth) return 0;
        turn_next(Nothing());
        std::size_t k = kWidth;
        for (; k + kWidth <= job_.count; k += kWidth) turn_next(write);
        Flow flow(job_, in, writer);
        write(flow);
        return k;
    }

    template <class Flow>
    HWY_INLINE void turn_row(const Turn& turn, const T* in, T* out, std::size_t stride, Flow flow) const {
        // Odd orders have one column more than whole blocks: band 0, which no rotation changes, is copied.
        if constexpr (kFirst == 0 && kColumns % kBlock<T> == 1) {
            if (!is_touching_nine<kColumns>(stride)) {
                turn_columns<1>(turn, in + 1, out + 1, stride, flow);
                for (std::size_t k = 0; k < kWidth; ++k) out[k * stride] = in[k * stride];
                return;
            }
        }
        turn_columns<kFirst>(turn, in, out, stride, flow);
    }

    /// Coefficients from kFrom on, which is 0 or 1; band 0 is neither read nor written where it is 1.
    template <std::size_t kFrom, class Flow>
    HWY_INLINE void turn_columns(const Turn& turn, const T* in, T* out, std::size_t stride, Flow flow) const {
        P f[kCoefficients];
        if constexpr (kFrom == 1) f[0].lanes = hn::Zero(Tag<T>());
        read_columns<kCoefficients - kFrom>(in, stride, f + kFrom, [&] { flow.read(); });
        turn(f);
        write_columns<kCoefficients - kFrom>(f + kFrom, out, stride, [&] { flow.write(); });
    }

    template <class Flow>
    HWY_NOINLINE void turn_channels(const Turn& turn, const T* in, T* out, Flow flow) const {
        if (job_.is_interleaved) return turn_interleaved(turn, in, out, flow);
        for (std::size_t channel = 0; channel < job_.channels; ++channel) {
            for (std::size_t column = 0; column < kColumns; column += kBlock<T>) flow.read();
            turn_channel(turn, in + channel * kColumns, out + channel * kColumns, job_.stride);
        }
    }

    HWY_NOINLINE void turn_channel(const Turn& turn, const T* in, T* out, std::size_t stride) const {
        turn_row(turn, in, out, stride, Small(job_, nullptr, nullptr));
    }

    template <class Flow>
    HWY_INLINE void turn_interleaved(const Turn& turn, const T* in, T* out, Flow flow) const {
        P f[kCoefficients * kMostInterleaved];
        const std::size_t columns = kColumns * job_.channels;
        read_slots(in, job_.stride, slots_, columns, f, [&] { flow.read(); });
        for (std::size_t channel = 0; channel < job_.channels; ++channel) {
            if constexpr (kFirst == 1) f[channel * kCoefficients].lanes = hn::Zero(Tag<T>());
            turn(f + channel * kCoefficients);
        }
        write_slots(f, slots_, columns, out, job_.stride, [&] { flow.write(); });
    }

    /// Vectors from k on, by way of the stack.
    HWY_NOINLINE void turn_rest(RotationForm form, Turn& turn, std::size_t k) const {
        const std::size_t step = job_.is_interleaved ? job_.channels : 1;
        for (; k < job_.count; k += kWidth) {
            const std::size_t live = job_.count - k < kWidth ? job_.count - k : kWidth;
            if constexpr (kHasOwn) load_some(form, turn, k, live);
            for (std::size_t channel = 0; channel < job_.channels; ++channel) {
                const std::size_t offset = k * job_.stride + channel * (job_.is_interleaved ? 1 : kColumns);
                turn_copies(turn, job_.in + offset, job_.out + offset, step, live);
            }
        }
    }

    /// Rotations k ... k + live - 1; the lanes beyond get the identity.
    HWY_NOINLINE void load_some(RotationForm form, Turn& turn, std::size_t k, std::size_t live) const {
        const T* values = job_.rotations + k * job_.rotation_stride;
        const std::size_t length = form == RotationForm::matrix ? 9 : 4;
        HWY_ALIGN T rows[kWidth * 9];
        for (std::size_t row = 0; row < kWidth; ++row) {
            for (std::size_t i = 0; i < length; ++i) {
                const bool is_one = length == 9 ? i % 4 == 0 : i == 3;
                rows[row * length + i] = row < live ? values[row * job_.rotation_stride + i] : T(is_one);
            }
        }
        turn.load(rows, length);
    }

    /// One channel of `live` vectors, coefficients `step` apart.
    HWY_NOINLINE void turn_copies(const Turn& turn, const T* in, T* out, std::size_t step,
                                  std::size_t live) const {
        constexpr std::size_t kLength = kRowLength<T, kColumns>;
        HWY_ALIGN T rows[kWidth * kLength];
        for (std::size_t k = 0; k < kWidth; ++k)
            for (std::size_t i = 0; i < kLength; ++i)
                rows[k * kLength + i] = k < live && i < kColumns ? in[k * job_.stride + i * step] : T(0);
        turn_channel(turn, rows, rows, kLength);
        for (std::size_t k = 0; k < live; ++k)
            for (std::size_t i = 0; i < kColumns; ++i)
                out[k * job_.stride + i * step] = rows[k * kLength + i];
    }

    const Job<T>& job_;
    unsigned short slots_[kColumns * kMostInterleaved + 1];  ///< of interleaved columns, see read_slots
};

template <int N, int kFirst, class Turn>
void run_each(const Job<T>& job) {
    Turn turn;
    Batch<N, kFirst, Turn>(job).run(job.form, turn);
}

template <int N, int kFirst, RotationForm kForm>
void each(const Job<T>& job) {
    // Products only: nothing that is worth keeping. Called: one call is better than two.
    constexpr bool kIsOnce = AtOnce<N>::kTakesMirrors || N > kLargestInlined;
    using One = std::conditional_t<kIsOnce, Once<N, kForm>, Prepared<N, kForm, Use::one_channel>>;
    job.channels == 1 ? run_each<N, kFirst, One>(job)
                      : run_each<N, kFirst, Prepared<N, kForm, Use::channels>>(job);
}

template <int N, int kFirst>
void each(const Job<T>& job) {
    job.form == RotationForm::matrix ? each<N, kFirst, RotationForm::matrix>(job)
                                     : each<N, kFirst, RotationForm::quaternion>(job);
}

template <int N, int kFirst>
void all(const Job<T>& job) {
    if constexpr (kHasBlocksOfFour<T> && turns_three_channels_densely(N))
        if (job.is_interleaved && job.channels == 3) return turn_three_channels<T, N, kFirst>(job);
    using Turn = Prepared<N, RotationForm::matrix, Use::all_vectors>;
    Turn turn;
    turn.load(job.rotations, 0);  // stride 0: the same in every lane
    Batch<N, kFirst, Turn>(job).run(job.form, turn);
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
