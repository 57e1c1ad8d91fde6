#pragma once

#include <cstdint>

namespace zonal::cases {

/// How many of so many random cases a test takes: all, or a part of them, at least one, where the environment
/// variable ZONAL_TEST_CASES_DIVISOR is a whole number above 1. Builds with sanitizers judge the path, not
/// the accuracy, and take minutes for all of them. Throws std::invalid_argument for what is no such number.
std::int64_t some_of(std::int64_t all);
/// Whether it takes its number-th case, from 0: the same part, spread over all.
bool takes(std::int64_t number);

}  // namespace zonal::cases
