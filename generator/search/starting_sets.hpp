#pragma once

#include "search/pool.hpp"
#include "search/problem.hpp"

namespace zonal::search {

/// Random lobes that are regular in the highest band: each keeps part of its length when what the others span
/// is taken away. Sets drawn blindly from a pool with much structure are nearly all singular. Where the pool
/// is too small for that, blindly drawn lobes complete the set.
LobeSet draw_regular(const Problem& problem, const CandidateGrid& grid, const Pool& pool, Random& random);

/// Random lobes in the order of the sparsest sets known of 12 bands and more, regular in every band: the
/// pole; for every odd l two more on the equator; for every even l one more on the great circle y = 0 and one
/// anywhere off the equator. On the equator no function that is odd in z is seen, on the circle none of the
/// sin(m phi), so Â falls apart in every band at once, as far as lobes can be shared: band l has l+1
/// functions that are even in z, and l+1 lobes on the equator (l, where l is even). Swaps of single lobes
/// seldom come to this order from another one. Falls back on `draw_regular`.
LobeSet draw_aligned(const Problem& problem, const CandidateGrid& grid, const Pool& pool, Random& random);

}  // namespace zonal::search
