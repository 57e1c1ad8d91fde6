#pragma once

#include <vector>

#include "search/refine.hpp"

namespace zonal::search {

/// Whether the cost at 50 digits is lower, or the same with fewer instructions to turn the lobes.
bool is_better(const Solution& a, const Solution& b, const Objective& objective);

/// The solutions that no other beats in nonzeros, multiplications and condition at once (the Pareto front),
/// with one more, which enters or not.
void add_to_front(std::vector<Solution>& front, const Solution& solution);

/// Fewest nonzeros first.
void sort_front(std::vector<Solution>& front);

}  // namespace zonal::search
