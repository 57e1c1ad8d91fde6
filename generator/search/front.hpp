#pragma once

#include <algorithm>
#include <vector>

#include "search/refine.hpp"

namespace zonal::search {

/// Whether the cost at 50 digits is lower, or the same with fewer instructions to turn the lobes.
bool is_better(const Solution& a, const Solution& b, const Objective& objective);

/// Whether `b` is as good in nonzeros, multiplications and condition at once.
bool is_beaten(const Score& a, const Score& b);

/// The solutions that no other beats (the Pareto front), with one more, which enters or not. `Item` is a
/// `Solution` or holds more.
template <class Item>
void add_to_front(std::vector<Item>& front, const Item& item) {
    const auto beats = [&](const Item& other) { return is_beaten(item.score, other.score); };
    if (std::ranges::any_of(front, beats)) return;
    std::erase_if(front, [&](const Item& other) { return is_beaten(other.score, item.score); });
    front.push_back(item);
}

/// Fewest nonzeros first.
template <class Item>
void sort_front(std::vector<Item>& front) {
    std::ranges::stable_sort(front, {}, [](const Item& item) { return item.score.nonzeros; });
}

}  // namespace zonal::search
