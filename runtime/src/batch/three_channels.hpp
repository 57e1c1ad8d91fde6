#pragma once

// One rotation for vectors of three interleaved channels, without transpositions: the dense product of each
// band (2l+1 columns), a block of 16 bytes for a coefficient. The three channels of coefficient j, and
// whatever lies behind them, are copied to every block of a register; a product with column j of the matrix
// adds to as many coefficients as there are blocks. The fourth lane of each block is never kept.
// A vector is read as a whole before any of it is written.

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
void turn_three_channels(const Job<T>&);

#else

/// A block of 16 bytes has room for three channels and one value more.
template <class T>
inline constexpr bool kHasBlocksOfFour = sizeof(T) == 4;

/// The dense matrices of order N >= 3, spread over registers. kFirst: 1 where band 0 is apart, else 0.
template <class T, int N, int kFirst>
class ThreeChannels {
  public:
    static constexpr std::size_t kLength = 3 * (static_cast<std::size_t>(N) * N - kFirst);  ///< of a vector

    /// Vectors that share what is read of the matrices, as far as registers suffice.
    static constexpr std::size_t kTogether = kLanes<T> >= 16 ? 2 : 1;

    explicit ThreeChannels(const T* rotation) {
        P R[9], dense[kMatrixValues];
        for (int i = 0; i < 9; ++i) R[i].lanes = hn::Set(Tag<T>(), rotation[i]);
        PackKernels<N>::blocks(R, dense);
        spread<1>(dense + 1);
        for (std::size_t i = 0; i < kLanes<T>; ++i) {
            const std::size_t kept = i < kKept ? i : kKept - 1;
            packed_[i] = static_cast<Index>(kept / 3 * 4 + kept % 3);
            const std::size_t part = i < kHalf ? i : i - kHalf + kKept - kHalf;
            halves_[i] = static_cast<Index>(part / 3 * 4 + part % 3);
        }
    }

    /// Turns kCount vectors `stride` apart from `in` to `out`, which may be the same.
    template <std::size_t kCount>
    HWY_INLINE void turn(const T* in, std::size_t stride, T* out) const {
        Lanes<T> sums[kCount][kRegisters];
        multiply<kFirst>(in, stride, sums);
        for (std::size_t k = 0; k < kCount; ++k) store<kFirst, 0>(sums[k], out + k * stride);
    }

  private:
    using P = Pack<T>;
    using Index = hwy::MakeSigned<T>;

    static constexpr std::size_t kBlocks = kLanes<T> / 4;  ///< coefficients in a register
    static constexpr std::size_t kKept = 3 * kBlocks;      ///< values of a register that are kept
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

    /// Where a coefficient begins in a vector.
    static constexpr std::size_t place(std::size_t l, std::size_t row) { return 3 * (l * l + row - kFirst); }

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

    /// Three values to every block; no value behind the vector is read.
    template <std::size_t kPlace>
    static HWY_INLINE Lanes<T> load(const T* vector) {
        if constexpr (kPlace + 4 <= kLength)
            return hn::LoadDup128(Tag<T>(), vector + kPlace);
        else
            return hn::Shuffle0321(hn::LoadDup128(Tag<T>(), vector + kPlace - 1));
    }

    template <std::size_t l, std::size_t kCount>
    HWY_INLINE void multiply(const T* in, std::size_t stride, Lanes<T> (&sums)[kCount][kRegisters]) const {
        if constexpr (l == 0) {
            for (std::size_t k = 0; k < kCount; ++k) sums[k][0] = load<0>(in + k * stride);
        } else {
            multiply_column<l, 0>(in, stride, sums);
        }
        if constexpr (l + 1 < N) multiply<l + 1>(in, stride, sums);
    }

    template <std::size_t l, std::size_t kColumn, std::size_t kCount>
    HWY_INLINE void multiply_column(const T* in, std::size_t stride,
                                    Lanes<T> (&sums)[kCount][kRegisters]) const {
        Lanes<T> x[kCount];
        for (std::size_t k = 0; k < kCount; ++k) x[k] = load<place(l, kColumn)>(in + k * stride);
        for (std::size_t index = 0; index < registers(l); ++index) {
            const Lanes<T> entries =
                hn::Load(Tag<T>(), columns_[columns_below(l) + kColumn * registers(l) + index]);
            for (std::size_t k = 0; k < kCount; ++k) {
                Lanes<T>& sum = sums[k][registers_below(l) + index];
                sum = kColumn == 0 ? hn::Mul(x[k], entries) : hn::MulAdd(x[k], entries, sum);
            }
        }
        if constexpr (kColumn + 1 < size(l)) multiply_column<l, kColumn + 1>(in, stride, sums);
    }

    /// Writes registers from `kIndex` of band l on. A whole register goes beyond what it keeps, into what is
    /// written next; the last ones are written as two halves that overlap.
    template <std::size_t l, std::size_t kIndex>
    HWY_INLINE void store(const Lanes<T> (&sums)[kRegisters], T* out) const {
        const Tag<T> d;
        constexpr std::size_t kPlace = place(l, first_row(l, kIndex));
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
            store<l, kIndex + 1>(sums, out);
        else if constexpr (l + 1 < N)
            store<l + 1, 0>(sums, out);
    }

    HWY_ALIGN T columns_[columns_below(N)][kLanes<T>];
    HWY_ALIGN Index packed_[kLanes<T>];  ///< the lanes that are kept
    HWY_ALIGN Index halves_[kLanes<T>];  ///< the first half of them, and the last
};

/// Turns a batch of three interleaved channels by its one rotation.
template <class T, int N, int kFirst>
void turn_three_channels(const Job<T>& job) {
    using Dense = ThreeChannels<T, N, kFirst>;
    constexpr std::size_t kStep = 8;  ///< vectors that are staged at once: within one page
    constexpr std::size_t kTogether = Dense::kTogether, kLength = Dense::kLength;
    using Writer = Stream<T, kStep * kLength>;
    constexpr std::size_t kPace = (kTogether * kLength + Writer::kLine - 1) / Writer::kLine * Writer::kLine;

    const Dense dense(job.rotations);
    Writer writer(job.out);
    const T* in = job.in;
    for (std::size_t k = 0; k < job.count; k += kStep) {
        const std::size_t live = job.count - k < kStep ? job.count - k : kStep;
        T* out = job.is_streamed ? writer.room() : job.out + k * job.stride;
        std::size_t i = 0;
        for (; i + kTogether <= live; i += kTogether) {
            if (job.is_streamed) writer.template write_some<kPace>();
            dense.template turn<kTogether>(in, job.stride, out);
            in += kTogether * job.stride;
            out += kTogether * job.stride;
        }
        for (; i < live; ++i, in += job.stride, out += job.stride)
            dense.template turn<1>(in, job.stride, out);
        if (job.is_streamed) writer.advance(live * kLength);
    }
    if (job.is_streamed) writer.finish();
}

#endif

}  // namespace
}  // namespace zonal::batch
