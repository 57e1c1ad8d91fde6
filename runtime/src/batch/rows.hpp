#pragma once

// The walk over vectors whose coefficients, or channels, touch: a pack of rows at a time, transposed in
// registers, turned in place and written back.

#include "planes.hpp"
#include "stream.hpp"

namespace zonal::batch {
namespace {

/// Whether the loops are also compiled for the most common layouts. Not for the narrow instruction sets of
/// x86, which serve old processors: compiling them takes long enough as it is.
constexpr bool kHasCommonLayouts = !HWY_ARCH_X86 || HWY_TARGET <= HWY_AVX2;

/// Bytes ahead of the vectors in work that are fetched into the first cache, and farther ahead into the
/// second, where batches are larger than the caches: the first cache alone does not have enough lines under
/// way to hide memory.
constexpr std::size_t kNear = 4096;
constexpr std::size_t kFar = 32768;

/// Fetches cache lines ahead of `length` values.
template <class T>
HWY_INLINE void fetch_ahead(const T* values, std::size_t length) {
    const char* bytes = reinterpret_cast<const char*>(values);
    for (std::size_t i = 0; i < length * sizeof(T); i += 64) {
        hwy::Prefetch(bytes + kNear + i);
#if HWY_COMPILER_GCC || HWY_COMPILER_CLANG
        __builtin_prefetch(bytes + kFar + i, 0, 2);
#endif
    }
}

/// Interleaved channels that are transposed together, as blocks of their columns.
template <class T, int N, int kFirst>
class InterleavedBlocks {
  public:
    static constexpr std::size_t kCoefficients = static_cast<std::size_t>(N) * N;
    static constexpr std::size_t kColumns = kCoefficients - kFirst;

    /// Vectors of more channels are turned in groups of kGroupOf, the last of up to kMost: its blocks overlap
    /// one another rather than those of another group, which may be turned and written already.
    static constexpr std::size_t kGroupOf = 4;
    static constexpr std::size_t kBytes = kCoefficients * kLanes<T> * sizeof(T);  ///< of a channel
    static constexpr std::size_t kFitting = kMostBytes / 2 / kBytes;
    static constexpr std::size_t kMost = kFitting >= 2 * kGroupOf - 1 ? 2 * kGroupOf - 1
                                         : kFitting >= kGroupOf       ? kGroupOf
                                         : kMostBytes / kBytes >= 3   ? 3
                                                                      : 1;

    /// Whether vectors of so many channels are read and written in blocks.
    static constexpr bool is_for(std::size_t channels) {
        return channels <= kMost || kMost == 2 * kGroupOf - 1;
    }

    InterleavedBlocks() : blocks_{places_, slots_, 0, 0} {}

    /// Whole vectors of channels <= kMost.
    void take_whole(std::size_t channels) {
        const std::size_t columns = kColumns * channels;
        for (std::size_t c = 0; c < columns; c += kBlock<T>) {
            const std::size_t from = c + kBlock<T> <= columns ? c : columns - kBlock<T>;
            add(from, [&](std::size_t j) {
                return (from + j) % channels * kCoefficients + kFirst + (from + j) / channels;
            });
        }
        blocks_.touching = columns / kBlock<T>;
    }

    /// Channels 0 ... count - 1 of vectors of more; kGroupOf <= count <= kMost.
    void take_group(std::size_t count, std::size_t channels) {
        for (std::size_t i = 0; i < kColumns; ++i) {
            for (std::size_t c = 0; c < count; c += kBlock<T>) {
                const std::size_t from = c + kBlock<T> <= count ? c : count - kBlock<T>;
                add(i * channels + from,
                    [&](std::size_t j) { return (from + j) * kCoefficients + kFirst + i; });
            }
        }
    }

    const Blocks& get() const { return blocks_; }

  private:
    static constexpr std::size_t kMostBlocks = kColumns * ((kMost + kBlock<T> - 1) / kBlock<T>)+1;

    template <class SlotOf>
    void add(std::size_t place, const SlotOf& slot_of) {
        places_[blocks_.count] = static_cast<unsigned short>(place);
        for (std::size_t j = 0; j < kBlock<T>; ++j)
            slots_[blocks_.count * kBlock<T> + j] = static_cast<unsigned short>(slot_of(j));
        ++blocks_.count;
    }

    Blocks blocks_;
    unsigned short places_[kMostBlocks], slots_[kMostBlocks * kBlock<T>];
};

/// A batch of order N in rows. kFirst: 1 where band 0 is apart, else 0.
template <class T, int N, int kFirst, class Turn>
class Rows {
  public:
    explicit Rows(const Job<T>& job) : job_(job) {
        if (job.shape != Shape::interleaved || !is_in_blocks(job)) return;
        if (job.channels <= kMost) {
            last_.take_whole(job.channels);
        } else {
            groups_.take_group(Interleaved::kGroupOf, job.channels);
            last_.take_group(Interleaved::kGroupOf + job.channels % Interleaved::kGroupOf, job.channels);
        }
    }

    /// Whether all vectors can be turned here; else by copies.
    static bool is_in_blocks(const Job<T>& job) {
        return kColumns >= kBlock<T> && (job.shape == Shape::rows || Interleaved::is_for(job.channels));
    }

    /// Whole packs; returns the number of vectors turned.
    std::size_t turn_packs(Turn& turn) const {
        if (job_.is_streamed && job_.channels <= kMostStreamed) return turn_streamed(turn);
        return turn_rows(turn, Writer(job_.out));
    }

  private:
    using P = Pack<T>;
    using Interleaved = InterleavedBlocks<T, N, kFirst>;

    static constexpr std::size_t kWidth = kLanes<T>;
    static constexpr std::size_t kCoefficients = Interleaved::kCoefficients;
    static constexpr std::size_t kColumns = Interleaved::kColumns;  ///< of one channel in memory
    static constexpr std::size_t kMost = Interleaved::kMost;

    static constexpr bool kHasOwn = Turn::kUse != Use::all_vectors;  ///< rotations, for each vector one

    /// Channels of which two stages fit beside the packs of a step: one, up to four.
    static constexpr std::size_t kLeft =
        kMost * Interleaved::kBytes < kMostBytes ? kMostBytes - kMost * Interleaved::kBytes : 0;
    static constexpr std::size_t kFittingStages = kLeft / (2 * Interleaved::kBytes);
    static constexpr std::size_t kMostStreamed = kFittingStages < 1   ? 1
                                                 : kFittingStages < 4 ? kFittingStages
                                                                      : 4;

    using Writer = Output<T, kWidth * kColumns * kMostStreamed>;

    /// What goes on between transpositions of kBlock columns: nothing in batches that fit the caches ...
    struct Small {
        HWY_INLINE Small(const Job<T>&, const T*, const Writer&) {}
        HWY_INLINE void read() {}
        HWY_INLINE void write() {}
    };

    /// ... and reading ahead and writing what waits, as fast as columns are read and written, in others.
    class Large {
      public:
        HWY_INLINE Large(const Job<T>& job, const T* in, const Writer& writer)
            : in_(job.is_large ? in : nullptr), writer_(writer) {}

        HWY_INLINE void read() {
            if (in_ == nullptr) return;
            fetch_ahead(in_, kStep);
            in_ += kStep;
            write();
        }
        HWY_INLINE void write() { writer_.template write_some<kPace>(); }

      private:
        static constexpr std::size_t kBlocks = kColumns < kBlock<T> ? 1 : kColumns / kBlock<T>;
        /// Values fetched ahead for each whole block of columns: together those of a pack of one channel.
        static constexpr std::size_t kStep = (kWidth * kColumns + kBlocks - 1) / kBlocks;

        /// Half of the lines of kBlock columns: as many are written while reading as while writing.
        static constexpr std::size_t kLine = Writer::Values::kLineBytes / sizeof(T);
        static constexpr std::size_t kPace = kWidth * kBlock<T> < 2 * kLine ? kLine : kWidth * kBlock<T> / 2;

        const T* in_;
        const Writer& writer_;
    };

    HWY_NOINLINE std::size_t turn_streamed(Turn& turn) const {
        typename Writer::Values stream(job_.out);
        const std::size_t done = turn_rows(turn, Writer(job_.out, &stream));
        stream.finish();
        return done;
    }

    /// Copies of the loop for what is most common; constant addresses pay where the kernel is part of the
    /// loop.
    HWY_INLINE std::size_t turn_rows(Turn& turn, const Writer& writer) const {
        if constexpr (kHasCommonLayouts && kFirst == 0 && Turn::kUse != Use::channels) {
            const bool is_common = job_.channels == 1 && job_.in_stride == kColumns &&
                                   job_.out_stride == kColumns && job_.coefficient_form == nullptr &&
                                   (!kHasOwn || (job_.rotation_stride == rotation_length(job_.form) &&
                                                 job_.matrix_form == nullptr));
            if constexpr (kMayTouchNine<kColumns>) {
                if (is_common && job_.is_large) return turn_nine<Large>(turn, writer);
                if (is_common) return turn_nine<Small>(turn, writer);
            } else if constexpr (N <= kLargestInlined) {
                if (is_common && job_.is_large) return turn_rows<Large, true>(turn, writer);
                if (is_common) return turn_rows<Small, true>(turn, writer);
            } else {
                if (is_common && !job_.is_large) return turn_rows<Small, false>(turn, writer);
            }
        }
        return turn_rows<Large, false>(turn, writer);
    }

    /// kIsTouching: vectors of one channel and rotations lie without gaps, so that addresses are constants.
    template <class Flow, bool kIsTouching>
    HWY_NOINLINE ZONAL_FLATTEN std::size_t turn_rows(Turn& turn, Writer writer) const {
        const std::size_t in_stride = kIsTouching ? kColumns : job_.in_stride;
        const std::size_t out_stride = kIsTouching ? kColumns : job_.out_stride;
        const RotationForm form = job_.form;
        const std::size_t rotations_step =
            kWidth * (kIsTouching ? rotation_length(form) : job_.rotation_stride);
        const T* in = job_.in;
        const T* rotations = job_.rotations;
        std::size_t k = 0;
        for (; k + kWidth <= job_.count; k += kWidth) {
            T* const to = writer.room();
            if constexpr (Turn::kUse == Use::one_channel) {
                Turn local;  // one of its own in every round stays in registers
                local.take(form, [&](P* R) { load_rotations<kIsTouching>(job_, rotations, R); });
                turn_row(local, in, in_stride, to, out_stride, Flow(job_, in, writer));
            } else if constexpr (Turn::kUse == Use::channels) {
                turn.take(form, [&](P* R) { load_rotations<false>(job_, rotations, R); });
                turn_channels(turn, in, to, Flow(job_, in, writer));
            } else if (kIsTouching || HWY_LIKELY(job_.channels == 1 && job_.coefficient_form == nullptr)) {
                turn_row(turn, in, in_stride, to, out_stride, Flow(job_, in, writer));
            } else {
                turn_channels(turn, in, to, Flow(job_, in, writer));
            }
            if constexpr (kHasOwn) {
                if (job_.is_large) fetch_ahead(rotations, rotations_step);
                rotations += rotations_step;
            }
            writer.advance(kWidth * out_stride);
            in += kWidth * in_stride;
        }
        return k;
    }

    /// Order 3 where everything touches: a pack is written after the next one is read. The kernel is short,
    /// and most of its operations wait for one another; reading and writing side by side fill the time.
    /// Kernels of higher orders fill it by themselves, and would keep what waits outside of registers.
    template <class Flow>
    HWY_NOINLINE ZONAL_FLATTEN std::size_t turn_nine(Turn& turn, Writer writer) const {
        const RotationForm form = job_.form;
        const std::size_t rotations_step = kWidth * rotation_length(form);
        const T* in = job_.in;
        const T* rotations = job_.rotations;
        P turned[kColumns];
        const auto write = [&](Flow& flow) {
            write_columns<kColumns>(turned, writer.room(), kColumns, [&] { flow.write(); });
            writer.advance(kWidth * kColumns);
        };
        const auto turn_next = [&](const auto& after_reading) {
            Flow flow(job_, in, writer);
            Turn own;
            if constexpr (kHasOwn) {
                own.take(form, [&](P* R) { load_rotations<true>(job_, rotations, R); });
                if (job_.is_large) fetch_ahead(rotations, rotations_step);
                rotations += rotations_step;
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

    template <class AnyTurn, class Flow>
    HWY_INLINE void turn_row(const AnyTurn& turn, const T* in, std::size_t in_stride, T* out,
                             std::size_t out_stride, Flow flow) const {
        // Odd orders have one column more than whole blocks: band 0, which no rotation changes, is copied.
        if constexpr (kFirst == 0 && kColumns % kBlock<T> == 1) {
            if (!is_touching_nine<kColumns>(in_stride) && !is_touching_nine<kColumns>(out_stride)) {
                turn_columns<1>(turn, in + 1, in_stride, out + 1, out_stride, flow);
                for (std::size_t k = 0; k < kWidth; ++k) out[k * out_stride] = in[k * in_stride];
                return;
            }
        }
        turn_columns<kFirst>(turn, in, in_stride, out, out_stride, flow);
    }

    /// Coefficients from kFrom on, which is 0 or 1; band 0 is neither read nor written where it is 1.
    template <std::size_t kFrom, class AnyTurn, class Flow>
    HWY_INLINE void turn_columns(const AnyTurn& turn, const T* in, std::size_t in_stride, T* out,
                                 std::size_t out_stride, Flow flow) const {
        P f[kCoefficients];
        if constexpr (kFrom == 1) f[0].lanes = hn::Zero(Tag<T>());
        read_columns<kCoefficients - kFrom>(in, in_stride, f + kFrom, [&] { flow.read(); });
        turn(f);
        write_columns<kCoefficients - kFrom>(f + kFrom, out, out_stride, [&] { flow.write(); });
    }

    template <class Flow>
    HWY_INLINE void turn_channels(const Turn& turn, const T* in, T* out, Flow flow) const {
        if (job_.shape == Shape::interleaved) return turn_interleaved(turn, in, out, flow);
        for (std::size_t channel = 0; channel < job_.channels; ++channel) {
            for (std::size_t column = 0; column < kColumns; column += kBlock<T>) flow.read();
            turn_channel(turn, in + channel * kColumns, out + channel * kColumns);
        }
    }

    HWY_NOINLINE void turn_channel(const Turn& turn, const T* in, T* out) const {
        if (HWY_UNLIKELY(job_.coefficient_form != nullptr))
            turn_row(InForm<Turn, T>{*job_.coefficient_form, turn}, in, job_.in_stride, out, job_.out_stride,
                     Small(job_, nullptr, Writer(nullptr)));
        else
            turn_row(turn, in, job_.in_stride, out, job_.out_stride, Small(job_, nullptr, Writer(nullptr)));
    }

    template <class Flow>
    HWY_INLINE void turn_interleaved(const Turn& turn, const T* in, T* out, Flow flow) const {
        std::size_t channel = 0;
        for (; job_.channels - channel > kMost; channel += Interleaved::kGroupOf)
            turn_group(turn, groups_.get(), Interleaved::kGroupOf, in + channel, out + channel, flow);
        turn_group(turn, last_.get(), job_.channels - channel, in + channel, out + channel, flow);
    }

    template <class Flow>
    HWY_NOINLINE void turn_group(const Turn& turn, const Blocks blocks, std::size_t channels, const T* in,
                                 T* out, Flow& flow) const {
        P f[kCoefficients * kMost];
        read_blocks(in, job_.in_stride, blocks, f, [&] { flow.read(); });
        for (std::size_t channel = 0; channel < channels; ++channel) {
            P* const of_channel = f + channel * kCoefficients;
            if constexpr (kFirst == 1) of_channel[0].lanes = hn::Zero(Tag<T>());
            if (HWY_UNLIKELY(job_.coefficient_form != nullptr))
                turn_in_form(*job_.coefficient_form, turn, of_channel);
            else
                turn(of_channel);
        }
        write_blocks(f, blocks, out, job_.out_stride, [&] { flow.write(); });
    }

    const Job<T>& job_;
    Interleaved groups_, last_;
};

}  // namespace
}  // namespace zonal::batch
