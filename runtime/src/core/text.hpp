#pragma once

// Small pieces of text for messages, the same in every locale. (std::format is not in g++ 12.)

#include <charconv>
#include <cmath>
#include <concepts>
#include <string>
#include <string_view>

namespace zonal {

inline std::string text_of(std::string_view text) { return std::string(text); }

template <std::integral Number>
std::string text_of(Number number) {
    return std::to_string(number);
}

/// The shortest text that reads back as the same number.
template <std::floating_point Number>
std::string text_of(Number number) {
    char text[32];
    return {text, std::to_chars(text, text + sizeof text, number).ptr};
}

/// As printf's %.{digits}g.
inline std::string rounded(double number, int digits) {
    char text[64];
    return {text, std::to_chars(text, text + sizeof text, number, std::chars_format::general, digits).ptr};
}

/// The same, but never less than the number: what a message asks for must be accepted when it is given.
inline std::string rounded_up(double number, int digits) {
    const std::string nearest = rounded(number, digits);
    double read = 0;
    std::from_chars(nearest.data(), nearest.data() + nearest.size(), read);
    if (!(read < number)) return nearest;
    return rounded(number + std::pow(10.0, std::floor(std::log10(std::abs(number))) + 1 - digits), digits);
}

/// Texts and numbers, one behind the other.
template <class... Pieces>
std::string joined(const Pieces&... pieces) {
    std::string result;
    ((result += text_of(pieces)), ...);
    return result;
}

/// "1, 2, 3"
template <class Range>
std::string list_of(const Range& values) {
    std::string result;
    for (const auto& value : values) {
        if (!result.empty()) result += ", ";
        result += text_of(value);
    }
    return result;
}

}  // namespace zonal
