#pragma once

// Reads rows (vectors) into packs of columns (coefficients) and writes them back, in registers.
// A register is seen as blocks of 16 bytes, kBlock values each. One load and inserts from memory bring block
// b of register j the columns c ... c + kBlock - 1 of row b kBlock + j; a transposition within the blocks
// leaves in register j column c + j of every row, in the order of the rows. Writing is the reverse, row by
// row: processors write two blocks at once when both go to one cache line. Columns that are left over are met
// by a last block that overlaps the one before. What `between` does happens once for every kBlock columns,
// beside the transpositions. Nine columns of rows that touch have a way of their own (touching_nine.hpp).

#include "pack.hpp"
#include "touching_nine.hpp"

namespace zonal::batch {
namespace {

template <class T>
inline constexpr std::size_t kBlock = kLanes<T> * sizeof(T) < 16 ? 1 : 16 / sizeof(T);

/// Blocks of a register.
template <class T>
inline constexpr std::size_t kGroup = kLanes<T> / kBlock<T>;

#if HWY_TARGET == HWY_SCALAR

template <class T>
HWY_INLINE Lanes<T> load_blocks(Tag<T> d, const T* p, std::size_t) {
    return hn::LoadU(d, p);
}

template <std::size_t kIndex, class T>
HWY_INLINE void store_one_block(Tag<T> d, Lanes<T> value, T* p) {
    hn::StoreU(value, d, p);
}

template <class T>
HWY_INLINE void transpose_blocks(Lanes<T> (&)[1]) {}

#else

/// Block b from memory at p + b * step.
template <class D, class T>
HWY_INLINE hn::Vec<D> load_blocks(D d, const T* p, std::size_t step) {
    constexpr std::size_t kBlocks = hn::MaxLanes(D()) / kBlock<T>;
    if constexpr (kBlocks == 1) {
        return hn::LoadU(d, p);
    } else if constexpr (kBlocks == 2) {
        const hn::Half<D> half;
        return hn::Combine(d, hn::LoadU(half, p + step), hn::LoadU(half, p));
    } else {
#if ZONAL_PACKS_ARE_AVX512  // one masked load each; halves would take a shuffle more
        const auto block = [&](std::size_t b) {
            return _mm_loadu_si128(reinterpret_cast<const __m128i*>(p + b * step));
        };
        __m512i values = _mm512_castsi128_si512(block(0));
        values = _mm512_mask_broadcast_i32x4(values, 0x00F0, block(1));
        values = _mm512_mask_broadcast_i32x4(values, 0x0F00, block(2));
        values = _mm512_mask_broadcast_i32x4(values, 0xF000, block(3));
        return hn::BitCast(d, hn::Vec<hn::RebindToUnsigned<D> >{values});
#endif
    }
}

/// Writes block kIndex of a register.
template <std::size_t kIndex, class D, class T>
HWY_INLINE void store_one_block(D d, hn::Vec<D> values, T* p) {
    constexpr std::size_t kBlocks = hn::MaxLanes(D()) / kBlock<T>;
    if constexpr (kBlocks == 1) {
        hn::StoreU(values, d, p);
    } else if constexpr (kBlocks == 2) {
        const hn::Half<D> half;
        hn::StoreU(kIndex == 0 ? hn::LowerHalf(half, values) : hn::UpperHalf(half, values), half, p);
    } else {
#if ZONAL_PACKS_ARE_AVX512  // typed as the values are: g++ then extracts while storing, without a shuffle
        if constexpr (sizeof(T) == 4)
            _mm_storeu_ps(p, _mm512_extractf32x4_ps(values.raw, kIndex));
        else
            _mm_storeu_pd(p, _mm512_extractf64x2_pd(values.raw, kIndex));
#endif
    }
}

/// Transposes within each block of 16 bytes. Interleaving whole numbers: Intel's processors since Ice Lake
/// have two units for that and one for the same on floating-point registers.
template <class T>
HWY_INLINE void transpose_blocks(Lanes<T> (&r)[kBlock<T>]) {
    if constexpr (kBlock<T> == 4) {
        const hn::RebindToUnsigned<Tag<T> > d;
        const auto even0 = hn::InterleaveLower(d, hn::BitCast(d, r[0]), hn::BitCast(d, r[2]));
        const auto even1 = hn::InterleaveUpper(d, hn::BitCast(d, r[0]), hn::BitCast(d, r[2]));
        const auto odd0 = hn::InterleaveLower(d, hn::BitCast(d, r[1]), hn::BitCast(d, r[3]));
        const auto odd1 = hn::InterleaveUpper(d, hn::BitCast(d, r[1]), hn::BitCast(d, r[3]));
        r[0] = hn::BitCast(Tag<T>(), hn::InterleaveLower(d, even0, odd0));
        r[1] = hn::BitCast(Tag<T>(), hn::InterleaveUpper(d, even0, odd0));
        r[2] = hn::BitCast(Tag<T>(), hn::InterleaveLower(d, even1, odd1));
        r[3] = hn::BitCast(Tag<T>(), hn::InterleaveUpper(d, even1, odd1));
    } else if constexpr (kBlock<T> == 2) {
        const hn::RebindToUnsigned<Tag<T> > d;
        const auto r0 = hn::BitCast(d, r[0]);
        const auto r1 = hn::BitCast(d, r[1]);
        r[0] = hn::BitCast(Tag<T>(), hn::InterleaveLower(d, r0, r1));
        r[1] = hn::BitCast(Tag<T>(), hn::InterleaveUpper(d, r0, r1));
    }
}

#endif

/// kBlock columns of kLanes rows.
template <class T>
HWY_INLINE void load_block(const T* rows, std::size_t stride, Lanes<T> (&columns)[kBlock<T>]) {
    for (std::size_t j = 0; j < kBlock<T>; ++j)
        columns[j] = load_blocks(Tag<T>(), rows + j * stride, kBlock<T> * stride);
    transpose_blocks<T>(columns);
}

/// Row by row of the transposed registers of neighbouring blocks.
template <std::size_t kCount, std::size_t kIndex = 0, class T>
HWY_INLINE void store_rows(const Lanes<T> (&blocks)[kCount][kBlock<T>], T* row, std::size_t stride) {
    for (std::size_t j = 0; j < kBlock<T>; ++j, row += stride)
        for (std::size_t b = 0; b < kCount; ++b)
            store_one_block<kIndex>(Tag<T>(), blocks[b][j], row + b * kBlock<T>);
    if constexpr ((kIndex + 1) * kBlock<T> < kLanes<T>) store_rows<kCount, kIndex + 1>(blocks, row, stride);
}

/// Values a row must have in memory, so that reading or writing kColumns of it stays within it.
template <class T, std::size_t kColumns>
inline constexpr std::size_t kRowLength = kColumns < kBlock<T> ? kBlock<T> : kColumns;

struct Nothing {
    template <class... Arguments>
    HWY_INLINE void operator()(Arguments...) const {}
};

template <std::size_t kColumns, class T, class Between = Nothing>
HWY_INLINE void read_columns(const T* rows, std::size_t stride, Pack<T>* columns,
                             const Between& between = {}) {
    constexpr std::size_t kWhole = kColumns - kColumns % kBlock<T>;
    if constexpr (kMayTouchNine<kColumns>) {
        if (is_touching_nine<kColumns>(stride)) {
            for (std::size_t c = 0; c < kWhole; c += kBlock<T>) between();
            return read_touching_nine(rows, columns);
        }
    }
    Lanes<T> block[kBlock<T>];
    for (std::size_t c = 0; c < kWhole; c += kBlock<T>) {
        between();
        load_block(rows + c, stride, block);
        for (std::size_t j = 0; j < kBlock<T>; ++j) columns[c + j].lanes = block[j];
    }
    if constexpr (kWhole < kColumns) {
        constexpr std::size_t kLast = kRowLength<T, kColumns> - kBlock<T>;
        load_block(rows + kLast, stride, block);
        for (std::size_t c = kWhole; c < kColumns; ++c) columns[c].lanes = block[c - kLast];
    }
}

template <std::size_t kCount, class T, class Between>
HWY_INLINE void write_blocks(const Pack<T>* columns, T* rows, std::size_t stride, const Between& between) {
    Lanes<T> blocks[kCount][kBlock<T>];
    for (std::size_t b = 0; b < kCount; ++b) {
        between();
        for (std::size_t j = 0; j < kBlock<T>; ++j) blocks[b][j] = columns[b * kBlock<T> + j].lanes;
        transpose_blocks<T>(blocks[b]);
    }
    store_rows<kCount>(blocks, rows, stride);
}

template <std::size_t kColumns, class T, class Between = Nothing>
HWY_INLINE void write_columns(const Pack<T>* columns, T* rows, std::size_t stride,
                              const Between& between = {}) {
    constexpr std::size_t kBlocks = kColumns / kBlock<T>;
    if constexpr (kMayTouchNine<kColumns>) {
        if (is_touching_nine<kColumns>(stride)) {
            for (std::size_t b = 0; b < kBlocks; ++b) between();
            return write_touching_nine(columns, rows);
        }
    }
    constexpr std::size_t kWhole = kBlocks * kBlock<T>;
    constexpr std::size_t kRest = kBlocks == 0 ? 0 : (kBlocks - 1) % kGroup<T> + 1;  ///< of the last group
    for (std::size_t b = 0; b < kBlocks - kRest; b += kGroup<T>)
        write_blocks<kGroup<T> >(columns + b * kBlock<T>, rows + b * kBlock<T>, stride, between);
    constexpr std::size_t kFirst = kWhole - kRest * kBlock<T>;
    if constexpr (kRest > 0) write_blocks<kRest>(columns + kFirst, rows + kFirst, stride, between);
    if constexpr (kWhole < kColumns) {
        constexpr std::size_t kLast = kRowLength<T, kColumns> - kBlock<T>;
        Pack<T> padded[kBlock<T>];
        for (std::size_t j = 0; j < kBlock<T>; ++j)
            padded[j].lanes = kLast + j < kColumns ? columns[kLast + j].lanes : hn::Zero(Tag<T>());
        write_blocks<1>(padded, rows + kLast, stride, Nothing());
    }
}

/// Columns in blocks of kBlock that lie anywhere in a row: block b begins at value places[b], and its column
/// j is kept in columns[slots[b * kBlock + j]]. Blocks may overlap.
struct Blocks {
    const unsigned short* places;
    const unsigned short* slots;
    std::size_t count;
    std::size_t touching;  ///< so many from the first on touch
};

template <class T, class Between>
HWY_INLINE void read_blocks(const T* rows, std::size_t stride, const Blocks blocks, Pack<T>* columns,
                            const Between& between) {
    Lanes<T> block[kBlock<T>];
    for (std::size_t b = 0; b < blocks.count; ++b) {
        between();
        load_block(rows + blocks.places[b], stride, block);
        for (std::size_t j = 0; j < kBlock<T>; ++j) columns[blocks.slots[b * kBlock<T> + j]].lanes = block[j];
    }
}

template <class T, class Between>
HWY_INLINE void write_blocks(const Pack<T>* columns, const Blocks blocks, T* rows, std::size_t stride,
                             const Between& between) {
    Pack<T> group[kGroup<T> * kBlock<T>];
    std::size_t b = 0;
    for (; b + kGroup<T> <= blocks.touching; b += kGroup<T>) {
        for (std::size_t j = 0; j < kGroup<T> * kBlock<T>; ++j)
            group[j] = columns[blocks.slots[b * kBlock<T> + j]];
        write_blocks<kGroup<T> >(group, rows + blocks.places[b], stride, between);
    }
    for (; b < blocks.count; ++b) {
        for (std::size_t j = 0; j < kBlock<T>; ++j) group[j] = columns[blocks.slots[b * kBlock<T> + j]];
        write_blocks<1>(group, rows + blocks.places[b], stride, between);
    }
}

}  // namespace
}  // namespace zonal::batch
