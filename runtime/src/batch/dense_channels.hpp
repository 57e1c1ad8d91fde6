#pragma once

// One rotation for interleaved channels, without transpositions: the dense product of each band (2l+1
// columns), a block of 16 bytes for a coefficient. Up to four channels of coefficient j, and whatever lies
// behind them, are copied to every block of a register; a product with column j of the matrix adds to as many
// coefficients as there are blocks. More channels are turned four at a time.

#include "job.hpp"
#include "order_kernels.hpp"
#include "pack.hpp"
#include "stream.hpp"
#include "transpose.hpp"

namespace zonal::batch {
namespace {

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128  // no blocks, or such as are loops

template <class T>
inline constexpr bool kHasBlocksOfFour = false;

template <class T, int N, int kFirst>
void turn_densely(const Job<T>&);

#else

/// A block of 16 bytes has room for four channels.
template <class T>
inline constexpr bool kHasBlocksOfFour = sizeof(T) == 4;

/// The dense matrices of order N >= 3, spread over registers. kFirst: 1 where band 0 is apart, else 0.
/// kChannels: 2 or 3 channels that vectors have, whose values are packed in registers before they are
/// written; or 4 of any number that is known at run time only.
template <class T, int N, int kFirst, std::size_t kChannels>
class DenseChannels {
  public:
    static constexpr std::size_t kLength = kChannels * (static_cast<std::size_t>(N) * N - kFirst);

    /// Vectors that share what is read of the matrices, as far as registers suffice.
    static constexpr std::size_t kTogether = kLanes<T> >= 16 ? 2 : 1;

    static constexpr bool kIsPacked = kChannels < 4;

    explicit DenseChannels(const T* rotation) {
        P R[9], dense[kMatrixValues];
        for (int i = 0; i < 9; ++i) R[i].lanes = hn::Set(Tag<T>(), rotation[i]);
        PackKernels<N>::blocks(R, dense);
        spread<1>(dense + 1);
        for (std::size_t i = 0; i < kLanes<T>; ++i) {
            const std::size_t kept = i < kKept ? i : kKept - 1;
            packed_[i] = static_cast<Index>(kept / kChannels * 4 + kept % kChannels);
            const std::size_t part = i < kHalf ? i : i - kHalf + kKept - kHalf;
            halves_[i] = static_cast<Index>(part / kChannels * 4 + part % kChannels);
        }
    }

    /// Turns kCount vectors from `in` to `out`, which may be the same.
    template <std::size_t kCount>
    HWY_INLINE void turn(const Job<T>& job, const T* in, T* out) const {
        if constexpr (kIsPacked) {
            turn_four<kCount>(job, in, out);
        } else {
            // What is left over by fours overlaps another four: it is read first and written last.
            const std::size_t last = job.channels - 4;
            Lanes<T> kept[kCount][kRegisters];
            if (last % 4 != 0) multiply<kFirst>(in + last, job, kept);
            for (std::size_t channel = 0; channel <= last; channel += 4)
                turn_four<kCount>(job, in + channel, out + channel);
            if (last % 4 != 0) store_all<kCount>(kept, job, out + last);
        }
    }

    /// Turns `count` vectors, some lines of `output` leaving between them. Distances are read from the job: a
    /// compiler that knows them not to change keeps an address for every coefficient, in memory, and is
    /// slower.
    template <std::size_t kPace, class Writer>
    HWY_INLINE void turn_some(const Job<T>& job, const T* in, T* out, std::size_t count,
                              const Writer& output) const {
        std::size_t k = 0;
        for (; k + kTogether <= count; k += kTogether) {
            output.template write_some<kPace>();
            turn<kTogether>(job, in, out);
            in += kTogether * job.in_stride;
            out += kTogether * job.out_stride;
        }
        for (; k < count; ++k, in += job.in_stride, out += job.out_stride) turn<1>(job, in, out);
    }
    /// The same, called: packed matrices from order 4 on are better read where they are than copied to the
    /// stack, as a compiler does with what it knows not to change.
    template <std::size_t kPace, class Writer>
    HWY_NOINLINE void turn_some_called(const Job<T>& job, const T* in, T* out, std::size_t count,
                                       const Writer& output) const {
        turn_some<kPace>(job, in, out, count, output);
    }

  private:
    using P = Pack<T>;
    using Index = hwy::MakeSigned<T>;

    static constexpr std::size_t kBlocks = kLanes<T> / 4;      ///< coefficients in a register
    static constexpr std::size_t kKept = kChannels * kBlocks;  ///< values of a register that are kept
    static constexpr std::size_t kHalf = kLanes<T> / 2;
    static constexpr std::size_t kMatrixValues = static_cast<std::size_t>(N) * (4 * N * N - 1) / 3;

    static constexpr std::size_t size(std::size_t l) { return 2 * l + 1; }
    static constexpr std::size_t registers(std::size_t l) { return (size(l) + kBlocks - 1) / kBlocks; }

    /// Registers of the bands below l.
    static constexpr std::size_t registers_below(std::size_t l) {
        return l == kFirst ? 0 : registers_below(l - 1) + registers(l - 1);
    }
    static constexpr std::size_t kRegisters = registers_below(N);

    /// Registers of the matrices of the bands below l.
    static constexpr std::size_t columns_below(std::size_t l) {
        return l == 1 ? 0 : columns_below(l - 1) + size(l - 1) * registers(l - 1);
    }

    /// The first coefficient, within its band, of a register; the last one overlaps the one before it.
    static constexpr std::size_t first_row(std::size_t l, std::size_t index) {
        const std::size_t last = size(l) < kBlocks ? 0 : size(l) - kBlocks;
        return index * kBlocks < last ? index * kBlocks : last;
    }

    static constexpr std::size_t coefficient(std::size_t l, std::size_t row) { return l * l + row - kFirst; }

    template <std::size_t kCount>
    HWY_INLINE void turn_four(const Job<T>& job, const T* in, T* out) const {
        Lanes<T> sums[kCount][kRegisters];
        multiply<kFirst>(in, job, sums);
        store_all<kCount>(sums, job, out);
    }

    template <std::size_t kCount>
    HWY_INLINE void store_all(const Lanes<T> (&sums)[kCount][kRegisters], const Job<T>& job, T* out) const {
        for (std::size_t k = 0; k < kCount; ++k) {
            if constexpr (kIsPacked)
                store_packed<kFirst, 0>(sums[k], out + k * job.out_stride);
            else
                store_blocks<kFirst, 0>(sums[k], job.channels, out + k * job.out_stride);
        }
    }

    /// Entries of the matrices from band l on, each to the blocks that it multiplies.
    template <std::size_t l>
    void spread(const P* entries) {
        for (std::size_t column = 0; column < size(l); ++column) {
            for (std::size_t index = 0; index < registers(l); ++index) {
                T* const to = columns_[columns_below(l) + column * registers(l) + index];
                for (std::size_t block = 0; block < kBlocks; ++block) {
                    const std::size_t row = first_row(l, index) + block;
                    const P entry = row < size(l) ? entries[row * size(l) + column] : P(0);
                    store_one_block<0>(Tag<T>(), entry.lanes, to + 4 * block);
                }
            }
        }
        if constexpr (l + 1 < N) spread<l + 1>(entries + size(l) * size(l));
    }

    /// The channels of a coefficient to every block; no value behind the vector is read.
    template <std::size_t kCoefficient>
    static HWY_INLINE Lanes<T> load(const T* vector, std::size_t channels) {
        constexpr std::size_t kPlace = kChannels * kCoefficient;
        if constexpr (!kIsPacked)
            return hn::LoadDup128(Tag<T>(), vector + kCoefficient * channels);
        else if constexpr (kPlace + 4 <= kLength)
            return hn::LoadDup128(Tag<T>(), vector + kPlace);
        else if constexpr (kChannels == 3)
            return hn::Shuffle0321(hn::LoadDup128(Tag<T>(), vector + kPlace - 1));
        else
            return hn::Shuffle1032(hn::LoadDup128(Tag<T>(), vector + kPlace - 2));
    }

    template <std::size_t l, std::size_t kCount>
    HWY_INLINE void multiply(const T* in, const Job<T>& job, Lanes<T> (&sums)[kCount][kRegisters]) const {
        if constexpr (l == 0) {
            for (std::size_t k = 0; k < kCount; ++k)
                sums[k][0] = load<0>(in + k * job.in_stride, job.channels);
        } else {
            multiply_column<l, 0>(in, job, sums);
        }
        if constexpr (l + 1 < N) multiply<l + 1>(in, job, sums);
    }

    template <std::size_t l, std::size_t kColumn, std::size_t kCount>
    HWY_INLINE void multiply_column(const T* in, const Job<T>& job,
                                    Lanes<T> (&sums)[kCount][kRegisters]) const {
        Lanes<T> x[kCount];
        for (std::size_t k = 0; k < kCount; ++k)
            x[k] = load<coefficient(l, kColumn)>(in + k * job.in_stride, job.channels);
        for (std::size_t index = 0; index < registers(l); ++index) {
            const Lanes<T> entries =
                hn::Load(Tag<T>(), columns_[columns_below(l) + kColumn * registers(l) + index]);
            for (std::size_t k = 0; k < kCount; ++k) {
                Lanes<T>& sum = sums[k][registers_below(l) + index];
                sum = kColumn == 0 ? hn::Mul(x[k], entries) : hn::MulAdd(x[k], entries, sum);
            }
        }
        if constexpr (kColumn + 1 < size(l)) multiply_column<l, kColumn + 1>(in, job, sums);
    }

    /// Writes registers from `kIndex` of band l on. A whole register goes beyond what it keeps, into what is
    /// written next; the last ones are written as two halves that overlap.
    template <std::size_t l, std::size_t kIndex>
    HWY_INLINE void store_packed(const Lanes<T> (&sums)[kRegisters], T* out) const {
        const Tag<T> d;
        constexpr std::size_t kPlace = kChannels * coefficient(l, first_row(l, kIndex));
        const Lanes<T> sum = sums[registers_below(l) + kIndex];
        if constexpr (kPlace + kLanes<T> <= kLength) {
            if constexpr (kBlocks == 1)
                hn::StoreU(sum, d, out + kPlace);
            else
                hn::StoreU(hn::TableLookupLanes(sum, hn::SetTableIndices(d, packed_)), d, out + kPlace);
        } else {
            const hn::Half<Tag<T> > half;
            const Lanes<T> parts = hn::TableLookupLanes(sum, hn::SetTableIndices(d, halves_));
            hn::StoreU(hn::LowerHalf(half, parts), half, out + kPlace);
            hn::StoreU(hn::UpperHalf(half, parts), half, out + kPlace + kKept - kHalf);
        }
        if constexpr (kIndex + 1 < registers(l))
            store_packed<l, kIndex + 1>(sums, out);
        else if constexpr (l + 1 < N)
            store_packed<l + 1, 0>(sums, out);
    }

    /// The same of four channels, a block a coefficient.
    template <std::size_t l, std::size_t kRow>
    HWY_INLINE void store_blocks(const Lanes<T> (&sums)[kRegisters], std::size_t channels, T* out) const {
        constexpr std::size_t kWhole = (registers(l) - 1) * kBlocks;  ///< rows of registers but the last
        constexpr std::size_t kIndex = kRow < kWhole ? kRow / kBlocks : registers(l) - 1;
        store_one_block<kRow - first_row(l, kIndex)>(Tag<T>(), sums[registers_below(l) + kIndex],
                                                     out + coefficient(l, kRow) * channels);
        if constexpr (kRow + 1 < size(l))
            store_blocks<l, kRow + 1>(sums, channels, out);
        else if constexpr (l + 1 < N)
            store_blocks<l + 1, 0>(sums, channels, out);
    }

    HWY_ALIGN T columns_[columns_below(N)][kLanes<T>];
    HWY_ALIGN Index packed_[kLanes<T>];  ///< the lanes that are kept
    HWY_ALIGN Index halves_[kLanes<T>];  ///< the first half of them, and the last
};

/// Turns a batch of interleaved channels by its one rotation.
template <class T, int N, int kFirst, std::size_t kChannels>
HWY_NOINLINE void turn_densely(const Job<T>& job) {
    using Dense = DenseChannels<T, N, kFirst, kChannels>;
    constexpr std::size_t kStep = 8;  ///< vectors that are staged at once: within one page
    constexpr std::size_t kTogether = Dense::kTogether, kLength = Dense::kLength;
    using Writer = Output<T, kStep * kLength>;
    constexpr std::size_t kLine = Writer::Values::kLine;
    constexpr std::size_t kPace = (kTogether * kLength + kLine - 1) / kLine * kLine;

    const Dense dense(job.rotations);
    const auto turn = [&](const T* in, T* out, std::size_t count, const Writer& output) {
        if constexpr (N == 3 || kChannels == 4)
            dense.template turn_some<kPace>(job, in, out, count, output);
        else
            dense.template turn_some_called<kPace>(job, in, out, count, output);
    };
    if (!job.is_streamed || job.channels > kChannels)
        return turn(job.in, job.out, job.count, Writer(job.out));
    typename Writer::Values stream(job.out);
    Writer output(job.out, &stream);
    for (std::size_t k = 0; k < job.count; k += kStep) {
        const std::size_t live = job.count - k < kStep ? job.count - k : kStep;
        turn(job.in + k * job.in_stride, output.room(), live, output);
        output.advance(live * job.out_stride);
    }
    output.finish();
}

template <class T, int N, int kFirst>
void turn_densely(const Job<T>& job) {
    if (job.channels == 2) return turn_densely<T, N, kFirst, 2>(job);
    job.channels == 3 ? turn_densely<T, N, kFirst, 3>(job) : turn_densely<T, N, kFirst, 4>(job);
}

#endif

}  // namespace
}  // namespace zonal::batch
