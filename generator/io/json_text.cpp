#include "io/json_text.hpp"

#include <fmt/format.h>

namespace zonal {
namespace {

constexpr int kDeepest = 16;

}  // namespace

Json parse_json(const std::string& text) {
    const auto check_depth = [](int depth, Json::parse_event_t, Json&) {
        if (depth > kDeepest)
            throw WrongJson(fmt::format("more than {} brackets within each other", kDeepest));
        return true;
    };
    try {
        return Json::parse(text, check_depth);
    } catch (const Json::parse_error& error) {
        throw WrongJson(fmt::format("a break at byte {} of {}", error.byte, text.size()));
    } catch (const Json::exception&) {
        throw WrongJson("a number too large to be one");
    }
}

std::string shown_value(const Json& value) {
    constexpr std::size_t kMost = 80;
    const std::string text = value.dump();
    return text.size() <= kMost ? text : text.substr(0, kMost) + "…";
}

}  // namespace zonal
