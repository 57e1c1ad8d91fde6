#pragma once

// Nine columns of rows that touch, as matrices and vectors of order 3 lie in arrays, on AVX-512: nine whole
// registers. Value i of these is in column i mod 9 of row i / 9. A register has 8 or 16 lanes, and 9 has no
// divisor in common with these: so each lane meets every column once in the nine registers, and all lanes in
// the same order, only that they begin with different columns. With the columns numbered in that order, lane
// i of column number p is in register p + shift(i) of the ring of nine. The shift is undone in two steps of
// three registers each: its remainder modulo 3 with masks; the rest with permutations of two registers, which
// bring the rows in order as well.

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

    /// What permutations of two registers take: lanes of the first from 0 on, of the second from kCount on.
    struct alignas(64) Lookup {
        Index lane[kCount];
    };
    Lookup rows_of_column[9][2];  ///< which lanes of three registers a column is made of, in two steps
    Lookup rows_of_register[9][2];
    std::size_t column[9];                   ///< in the order above
    std::size_t number[9];                   ///< of a column in that order
    unsigned remainder_mask[3] = {0, 0, 0};  ///< lanes whose shift leaves this remainder

    constexpr NineRegisters() : rows_of_column{}, rows_of_register{}, column{}, number{} {
        for (std::size_t p = 0; p < 9; ++p) {
            column[p] = p * kCount % 9;
            number[column[p]] = p;
        }
        for (std::size_t lane = 0; lane < kCount; ++lane) {
            std::size_t shift = 0;
            while ((shift * kCount + lane) % 9 != 0) ++shift;
            remainder_mask[shift % 3] |= 1u << lane;
            for (std::size_t p = 0; p < 9; ++p) {
                const std::size_t row = ((p + shift) % 9 * kCount + lane) / 9;
                const auto choose = [&](Lookup* steps, std::size_t to, std::size_t from) {
                    steps[0].lane[to] = static_cast<Index>(from + (shift / 3 == 1 ? kCount : 0));
                    steps[1].lane[to] = static_cast<Index>(shift / 3 == 2 ? kCount + from : to);
                };
                choose(rows_of_column[column[p]], row, lane);
                choose(rows_of_register[(p + shift / 3 * 3) % 9], lane, row);
            }
        }
    }
};

template <class T>
inline constexpr NineRegisters<T> kNine;

/// In every lane the register that the remainder of its shift tells. Stores with masks instead would be
/// faster at multiples of 64 bytes, and much slower at other addresses.
template <class T>
HWY_INLINE Lanes<T> choose_three(Lanes<T> a, Lanes<T> b, Lanes<T> c) {
    using Mask = hn::Mask<Tag<T>>;
    const auto mask = [](unsigned bits) { return Mask{static_cast<decltype(Mask::raw)>(bits)}; };
    const Lanes<T> either = hn::IfThenElse(mask(kNine<T>.remainder_mask[1]), b, a);
    return hn::IfThenElse(mask(kNine<T>.remainder_mask[2]), c, either);
}

/// Of three registers one, as both steps of `steps` tell.
template <class T>
HWY_INLINE Lanes<T> look_up(Lanes<T> a, Lanes<T> b, Lanes<T> c,
                            const typename NineRegisters<T>::Lookup (&steps)[2]) {
    const __m512i first = _mm512_load_si512(steps[0].lane);
    const __m512i second = _mm512_load_si512(steps[1].lane);
    if constexpr (sizeof(T) == 4)
        return Lanes<T>{_mm512_permutex2var_ps(_mm512_permutex2var_ps(a.raw, first, b.raw), second, c.raw)};
    else
        return Lanes<T>{_mm512_permutex2var_pd(_mm512_permutex2var_pd(a.raw, first, b.raw), second, c.raw)};
}

template <class T>
HWY_INLINE void read_touching_nine(const T* rows, Pack<T>* columns) {
    Lanes<T> whole[9], shifted[9];
    for (std::size_t r = 0; r < 9; ++r) whole[r] = hn::LoadU(Tag<T>(), rows + r * kLanes<T>);
    for (std::size_t r = 0; r < 9; ++r)
        shifted[r] = choose_three<T>(whole[r], whole[(r + 1) % 9], whole[(r + 2) % 9]);
    for (std::size_t c = 0; c < 9; ++c) {
        const auto at = [&](std::size_t step) { return shifted[(kNine<T>.number[c] + step) % 9]; };
        columns[c].lanes = look_up<T>(at(0), at(3), at(6), kNine<T>.rows_of_column[c]);
    }
}

template <class T>
HWY_INLINE void write_touching_nine(const Pack<T>* columns, T* rows) {
    Lanes<T> shifted[9];
    for (std::size_t r = 0; r < 9; ++r) {
        const auto at = [&](std::size_t step) { return columns[kNine<T>.column[(r + step) % 9]].lanes; };
        shifted[r] = look_up<T>(at(0), at(6), at(3), kNine<T>.rows_of_register[r]);
    }
    for (std::size_t r = 0; r < 9; ++r) {
        const auto at = [&](std::size_t step) { return shifted[(r + 9 - step) % 9]; };
        hn::StoreU(choose_three<T>(at(0), at(1), at(2)), Tag<T>(), rows + r * kLanes<T>);
    }
}

#endif

}  // namespace
}  // namespace zonal::batch
