#pragma once

#include <functional>

#include "search/angled_lobe.hpp"
#include "search/score.hpp"

namespace zonal::search {

/// A set of lobes and its score at 50 digits.
struct Solution {
    AngledSet lobes;
    Score score;
};

/// A gain of cost that is worth leaving closed forms for.
inline constexpr double kWorthwhile = 0.02;

/// The solution of a set, scored at 50 digits.
Solution confirm(const Problem& problem, const AngledSet& lobes);

/// Leaves the grid: walks along the freedom that the zeros of Â leave to the angles, to further zeros and to
/// better conditions, as long as the 50-digit cost falls. Returns the start when nothing is gained. Stops
/// early when `is_stopped()`.
Solution refine(const Problem& problem, const Objective& objective, const Solution& start,
                const std::function<bool()>& is_stopped);

}  // namespace zonal::search
