#pragma once

// Reads rows (vectors) into packs of columns (coefficients) and writes them back, in registers.
// A register is seen as blocks of 16 bytes, kBlock values each. One load and inserts from memory bring block
// b of register j the columns c ... c + kBlock - 1 of row b kBlock + j; a transposition within the blocks
// leaves in register j column c + j of every row, in the order of the rows. Writing is the reverse.
// Columns that are left over are met by a last block that overlaps the one before.

#include "pack.hpp"

namespace zonal::batch {
namespace {

template <class T>
inline constexpr std::size_t kBlock = kLanes<T> * sizeof(T) < 16 ? 1 : 16 / sizeof(T);

#if HWY_TARGET == HWY_SCALAR

template <class T>
HWY_INLINE Lanes<T> load_blocks(Tag<T> d, const T* p, std::size_t) {
    return hn::LoadU(d, p);
}

template <class T>
HWY_INLINE void store_blocks(Tag<T> d, Lanes<T> value, T* p, std::size_t) {
    hn::StoreU(value, d, p);
}

template <class T>
HWY_INLINE void transpose_blocks(Lanes<T> (&)[1]) {}

#else

/// Block b from memory at p + b * step.
template <class D, class T>
HWY_INLINE hn::Vec<D> load_blocks(D d, const T* p, std::size_t step) {
    if constexpr (hn::MaxLanes(D()) <= kBlock<T>) {
        return hn::LoadU(d, p);
    } else {
        const hn::Half<D> half;
        constexpr std::size_t kBlocks = hn::MaxLanes(hn::Half<D>()) / kBlock<T>;
        return hn::Combine(d, load_blocks(half, p + kBlocks * step, step), load_blocks(half, p, step));
    }
}

template <class D, class T>
HWY_INLINE void store_blocks(D d, hn::Vec<D> values, T* p, std::size_t step) {
    if constexpr (hn::MaxLanes(D()) <= kBlock<T>) {
        hn::StoreU(values, d, p);
    } else {
        const hn::Half<D> half;
        constexpr std::size_t kBlocks = hn::MaxLanes(hn::Half<D>()) / kBlock<T>;
        store_blocks(half, hn::LowerHalf(half, values), p, step);
        store_blocks(half, hn::UpperHalf(half, values), p + kBlocks * step, step);
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

template <class T>
HWY_INLINE void store_block(Lanes<T> (&columns)[kBlock<T>], T* rows, std::size_t stride) {
    transpose_blocks<T>(columns);
    for (std::size_t j = 0; j < kBlock<T>; ++j)
        store_blocks(Tag<T>(), columns[j], rows + j * stride, kBlock<T> * stride);
}

/// Values a row must have in memory, so that reading or writing kColumns of it stays within it.
template <class T, std::size_t kColumns>
inline constexpr std::size_t kRowLength = kColumns < kBlock<T> ? kBlock<T> : kColumns;

template <std::size_t kColumns, class T>
HWY_INLINE void read_columns(const T* rows, std::size_t stride, Pack<T>* columns) {
    constexpr std::size_t kWhole = kColumns - kColumns % kBlock<T>;
    Lanes<T> block[kBlock<T>];
    for (std::size_t c = 0; c < kWhole; c += kBlock<T>) {
        load_block(rows + c, stride, block);
        for (std::size_t j = 0; j < kBlock<T>; ++j) columns[c + j].lanes = block[j];
    }
    if constexpr (kWhole < kColumns) {
        constexpr std::size_t kLast = kRowLength<T, kColumns> - kBlock<T>;
        load_block(rows + kLast, stride, block);
        for (std::size_t c = kWhole; c < kColumns; ++c) columns[c].lanes = block[c - kLast];
    }
}

template <std::size_t kColumns, class T>
HWY_INLINE void write_columns(const Pack<T>* columns, T* rows, std::size_t stride) {
    constexpr std::size_t kWhole = kColumns - kColumns % kBlock<T>;
    Lanes<T> block[kBlock<T>];
    for (std::size_t c = 0; c < kWhole; c += kBlock<T>) {
        for (std::size_t j = 0; j < kBlock<T>; ++j) block[j] = columns[c + j].lanes;
        store_block(block, rows + c, stride);
    }
    if constexpr (kColumns - kWhole == 1) {  // cheaper one by one, through memory
        HWY_ALIGN T last[kLanes<T>];
        hn::Store(columns[kWhole].lanes, Tag<T>(), last);
        for (std::size_t k = 0; k < kLanes<T>; ++k) rows[k * stride + kWhole] = last[k];
    } else if constexpr (kWhole < kColumns) {
        constexpr std::size_t kLast = kRowLength<T, kColumns> - kBlock<T>;
        for (std::size_t j = 0; j < kBlock<T>; ++j)
            block[j] = kLast + j < kColumns ? columns[kLast + j].lanes : hn::Zero(Tag<T>());
        store_block(block, rows + kLast, stride);
    }
}

/// The same where column c is kept in columns[slots[c]] and their number is known at run time only;
/// count >= kBlock.
template <class T>
HWY_INLINE void read_slots(const T* rows, std::size_t stride, const unsigned short* slots, std::size_t count,
                           Pack<T>* columns) {
    Lanes<T> block[kBlock<T>];
    for (std::size_t next = 0; next < count; next += kBlock<T>) {
        const std::size_t c = next + kBlock<T> <= count ? next : count - kBlock<T>;
        load_block(rows + c, stride, block);
        for (std::size_t j = 0; j < kBlock<T>; ++j) columns[slots[c + j]].lanes = block[j];
    }
}

template <class T>
HWY_INLINE void write_slots(const Pack<T>* columns, const unsigned short* slots, std::size_t count, T* rows,
                            std::size_t stride) {
    Lanes<T> block[kBlock<T>];
    for (std::size_t next = 0; next < count; next += kBlock<T>) {
        const std::size_t c = next + kBlock<T> <= count ? next : count - kBlock<T>;
        for (std::size_t j = 0; j < kBlock<T>; ++j) block[j] = columns[slots[c + j]].lanes;
        store_block(block, rows + c, stride);
    }
}

}  // namespace
}  // namespace zonal::batch
