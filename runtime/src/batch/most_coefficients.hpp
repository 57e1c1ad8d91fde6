#pragma once

#include <cstddef>

#include "zonal/orders.hpp"

namespace zonal::batch {

/// Of the largest order that is compiled in.
#define ZONAL_LARGER(N) largest = (N) > largest ? (N) : largest;
constexpr std::size_t most_coefficients() {
    std::size_t largest = 0;
    ZONAL_FOR_EACH_ORDER(ZONAL_LARGER)
    return largest * largest;
}
#undef ZONAL_LARGER

inline constexpr std::size_t kMostCoefficients = most_coefficients();

}  // namespace zonal::batch
