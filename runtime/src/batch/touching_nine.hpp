#pragma once

// Nine columns of rows that touch, as matrices and vectors of order 3 lie in arrays, on AVX-512: nine whole
// registers. Value i of these is in column i mod 9 of row i / 9. A register has 8 or 16 lanes, and 9 has no
// divisor in common with these: so each lane meets every column once in the nine registers, and all lanes in
// the same order, only that they begin with different columns. With the columns numbered in that order, lane
// i of column number p is in register p + shift(i) of the ring of nine. The shift is undone with masks, in
// two steps of three registers each: its remainder modulo 3, then the rest. One permutation of lanes brings
// the rows in order. Writing is the reverse. Permutations of two registers instead of the second step and
// that one would need 36 operations and not 45; on Zen 5 they took a sixth more time. Others were not tried.

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "pack.hpp"

namespace zonal::batch {
namespace {

template <std::size_t kColumns>
inline constexpr bool kMayTouchNine = kColumns == 9 && ZONAL_PACKS_ARE_AVX512;

/// Whether kColumns of rows `stride` apart are read and written in this way.
template <std::size_t kColumns>
HWY_INLINE constexpr bool is_touching_nine(std::size_t stride) {
    return kMayTouchNine<kColumns> && stride == 9;
}

#if ZONAL_PACKS_ARE_AVX512

template <class T>
struct NineRegisters {
    using Index = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    static constexpr std::size_t kCount = kLanes<T>;

    struct alignas(64) Lookup {
        Index of[kCount];
    };
    using Masks = unsigned[3];
    Lookup lanes_of_rows[9];  ///< of the column of this number: which lane has each row
    Lookup rows_of_lanes[9];  ///< which row each lane has
    std::size_t column[9];    ///< in the order above
    Masks by_remainder;       ///< lanes whose shift leaves this remainder modulo 3
    Masks by_quotient;        ///< lanes whose shift is this times 3 and the remainder

    constexpr NineRegisters() : lanes_of_rows{}, rows_of_lanes{}, column{}, by_remainder{}, by_quotient{} {
        for (std::size_t p = 0; p < 9; ++p) column[p] = p * kCount % 9;
        for (std::size_t lane = 0; lane < kCount; ++lane) {
            std::size_t shift = 0;
            while ((shift * kCount + lane) % 9 != 0) ++shift;
            by_remainder[shift % 3] |= 1u << lane;
            by_quotient[shift / 3] |= 1u << lane;
            for (std::size_t p = 0; p < 9; ++p) {
                const std::size_t row = ((p + shift) % 9 * kCount + lane) / 9;
                lanes_of_rows[p].of[row] = static_cast<Index>(lane);
                rows_of_lanes[p].of[lane] = static_cast<Index>(row);
            }
        }
    }
};

template <class T>
inline constexpr NineRegisters<T> kNine;

/// In every lane the register whose mask has it.
template <class T>
HWY_INLINE Lanes<T> choose(const typename NineRegisters<T>::Masks& masks, Lanes<T> a, Lanes<T> b,
                           Lanes<T> c) {
    using Mask = hn::Mask<Tag<T>>;
    const auto mask = [&](std::size_t i) { return Mask{static_cast<decltype(Mask::raw)>(masks[i])}; };
    return hn::IfThenElse(mask(2), c, hn::IfThenElse(mask(1), b, a));
}

/// Lane i of the result is lane lookup.of[i] of the register.
template <class T>
HWY_INLINE Lanes<T> permute(Lanes<T> lanes, const typename NineRegisters<T>::Lookup& lookup) {
    return hn::TableLookupLanes(lanes, hn::SetTableIndices(Tag<T>(), lookup.of));
}

template <class T>
HWY_INLINE void read_touching_nine(const T* rows, Pack<T>* columns) {
    const NineRegisters<T>& nine = kNine<T>;
    Lanes<T> whole[9], partly[9];
    for (std::size_t r = 0; r < 9; ++r) whole[r] = hn::LoadU(Tag<T>(), rows + r * kLanes<T>);
    for (std::size_t r = 0; r < 9; ++r)
        partly[r] = choose<T>(nine.by_remainder, whole[r], whole[(r + 1) % 9], whole[(r + 2) % 9]);
    for (std::size_t p = 0; p < 9; ++p) {
        const Lanes<T> lanes =
            choose<T>(nine.by_quotient, partly[p], partly[(p + 3) % 9], partly[(p + 6) % 9]);
        columns[nine.column[p]].lanes = permute<T>(lanes, nine.lanes_of_rows[p]);
    }
}

template <class T>
HWY_INLINE void write_touching_nine(const Pack<T>* columns, T* rows) {
    const NineRegisters<T>& nine = kNine<T>;
    Lanes<T> lanes[9], partly[9];
    for (std::size_t p = 0; p < 9; ++p)
        lanes[p] = permute<T>(columns[nine.column[p]].lanes, nine.rows_of_lanes[p]);
    for (std::size_t r = 0; r < 9; ++r)
        partly[r] = choose<T>(nine.by_quotient, lanes[r], lanes[(r + 6) % 9], lanes[(r + 3) % 9]);
    // Stores with masks would be faster at multiples of 64 bytes, and much slower at other addresses.
    for (std::size_t r = 0; r < 9; ++r) {
        const Lanes<T> whole =
            choose<T>(nine.by_remainder, partly[r], partly[(r + 8) % 9], partly[(r + 7) % 9]);
        hn::StoreU(whole, Tag<T>(), rows + r * kLanes<T>);
    }
}

#endif

}  // namespace
}  // namespace zonal::batch
