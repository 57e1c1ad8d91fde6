#pragma once

#include <optional>
#include <vector>

#include "search/angled_lobe.hpp"
#include "search/pattern.hpp"
#include "search/problem.hpp"

namespace zonal::search {

/// Moves those angles whose `is_free` flag is set (theta_0, phi_0, theta_1, …) as little as possible until
/// every relation of the pattern holds to 1e-45. Nothing when that does not happen within some twenty steps:
/// then the pattern was an illusion of double precision.
std::optional<AngledSet> polish(const Problem& problem, const AngledSet& lobes, const Pattern& pattern,
                                const std::vector<bool>& is_free);

/// The lobes with their angles moved to `angles` (theta_0, phi_0, theta_1, …, in double), polished until the
/// pattern holds, with theta in [0, pi/2] and phi in [0, 2 pi). Angles that did not move keep value and text.
std::optional<AngledSet> polish_moved(const Problem& problem, const AngledSet& lobes,
                                      const std::vector<double>& angles, const Pattern& pattern);

/// Largest residual of the pattern at 50 digits.
exact::Real largest_residual(const Problem& problem, const AngledSet& lobes, const Pattern& pattern);

}  // namespace zonal::search
