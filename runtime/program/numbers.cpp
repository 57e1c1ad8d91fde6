#include "program/numbers.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace zonal::program {

template <class T>
std::string Limits<T>::text() const {
    const std::string kind = std::is_floating_point_v<T> ? "a number" : "a whole number";
    const bool has_most = most != std::numeric_limits<T>::max();
    if (is_above_least)
        return fmt::format("{} above {}{}", kind, least, has_most ? fmt::format(", at most {}", most) : "");
    if (has_most) return fmt::format("{} from {} to {}", kind, least, most);
    return least == std::numeric_limits<T>::lowest() && least != 0
               ? kind
               : fmt::format("{}, at least {}", kind, least);
}

template <class T>
std::optional<T> number_in(std::string_view text, const Limits<T>& limits) {
    T number{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    if constexpr (std::is_floating_point_v<T>)
        if (!std::isfinite(number)) return std::nullopt;
    if (number < limits.least || number > limits.most || (limits.is_above_least && number == limits.least))
        return std::nullopt;
    return number;
}

template <class T>
std::string complaint(std::string_view text, const Limits<T>& limits) {
    return fmt::format("found '{}', wanted {}", text, limits.text());
}

template struct Limits<int>;
template struct Limits<std::uint64_t>;
template struct Limits<double>;
template std::optional<int> number_in(std::string_view, const Limits<int>&);
template std::optional<std::uint64_t> number_in(std::string_view, const Limits<std::uint64_t>&);
template std::optional<double> number_in(std::string_view, const Limits<double>&);
template std::string complaint(std::string_view, const Limits<int>&);
template std::string complaint(std::string_view, const Limits<std::uint64_t>&);
template std::string complaint(std::string_view, const Limits<double>&);

}  // namespace zonal::program
