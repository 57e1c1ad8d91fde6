#include "support/case_count.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <string>

namespace zonal::cases {

namespace {

int divisor() {
    const char* text = std::getenv("ZONAL_TEST_CASES_DIVISOR");
    if (text == nullptr) return 1;
    const std::string value = text;
    int number = 0;
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc() || end != value.data() + value.size() || number < 1)
        throw std::invalid_argument("ZONAL_TEST_CASES_DIVISOR: found '" + value +
                                    "', wanted a whole number from 1");
    return number;
}

}  // namespace

std::int64_t some_of(std::int64_t all) { return std::max<std::int64_t>(1, all / divisor()); }

bool takes(std::int64_t number) { return number % divisor() == 0; }

}  // namespace zonal::cases
