#include "program/shown.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstddef>

namespace zonal::program {
namespace {

struct Character {
    char32_t code = 0;
    std::size_t length = 0;  ///< bytes; 0 where they are no UTF-8
};

Character first_character(std::string_view text) {
    const auto byte = [&](std::size_t k) { return static_cast<unsigned char>(text[k]); };
    if (byte(0) < 0x80) return {byte(0), 1};
    const std::size_t length = byte(0) >= 0xF0 && byte(0) <= 0xF4   ? 4
                               : byte(0) >= 0xE0 && byte(0) <= 0xEF ? 3
                               : byte(0) >= 0xC2 && byte(0) <= 0xDF ? 2
                                                                    : 0;
    if (length == 0 || text.size() < length) return {};
    char32_t code = byte(0) & (0xFFU >> (length + 1));
    for (std::size_t k = 1; k < length; ++k) {
        if ((byte(k) & 0xC0U) != 0x80U) return {};
        code = code << 6U | (byte(k) & 0x3FU);
    }
    constexpr char32_t kLeast[] = {0x80, 0x800, 0x10000};  // else it is written longer than need be
    const bool is_surrogate = code >= 0xD800 && code <= 0xDFFF;
    if (code < kLeast[length - 2] || code > 0x10FFFF || is_surrogate) return {};
    return {code, length};
}

bool is_harmless(char32_t code) {
    const bool is_control = code < 0x20 || (code >= 0x7F && code < 0xA0);
    const bool breaks_lines = code == 0x2028 || code == 0x2029;
    const bool reverses = code == 0x200E || code == 0x200F || (code >= 0x202A && code <= 0x202E) ||
                          (code >= 0x2066 && code <= 0x2069);
    return !is_control && !breaks_lines && !reverses;
}

}  // namespace

std::string shown(std::string_view text) {
    std::string result;
    while (!text.empty()) {
        const Character character = first_character(text);
        const std::size_t length = character.length > 0 ? character.length : 1;
        for (const char byte : text.substr(0, length))
            result += character.length > 0 && is_harmless(character.code)
                          ? std::string(1, byte)
                          : fmt::format("\\x{:02x}", static_cast<unsigned char>(byte));
        text.remove_prefix(length);
    }
    return result;
}

std::string shown_on_stdout(std::string_view text) {
    return isatty(STDOUT_FILENO) != 0 ? shown(text) : std::string(text);
}

}  // namespace zonal::program
