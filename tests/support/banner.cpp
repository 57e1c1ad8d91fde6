#include "support/banner.hpp"

#include <fmt/format.h>

#include <fstream>
#include <regex>
#include <sstream>

namespace zonal::banner {

namespace {

std::smatch find(int order, const std::string& kernel, const std::string& text, const std::string& pattern) {
    std::smatch match;
    if (!std::regex_search(text, match, std::regex(pattern)))
        throw std::runtime_error(fmt::format("order {}: the header states nothing of {}", order, kernel));
    return match;
}

/// The header's first comment: expressions take long to find in all of it.
std::string banner_text(int order) {
    const std::string text = header_text(order);
    return text.substr(0, text.find("#pragma once"));
}

}  // namespace

std::string header_text(int order) {
    std::ifstream stream(fmt::format("{}/zonal/order{:02}.hpp", ZONAL_GENERATED_DIR, order));
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

Bound bound(int order, const std::string& kernel) {
    const std::string text = banner_text(order);
    const std::smatch match = find(
        order, kernel, text,
        " " + kernel +
            R"( relative error ([0-9.e+-]+) \(float\), ([0-9.e+-]+) \(double\),\s+//\s+for det R = \+1( or -1)?; excess ([0-9.]+))");
    return {std::stod(match[1]), std::stod(match[2]), std::stod(match[4]), match[3].matched};
}

bool comment_takes_mirrors(int order, const std::string& kernel) {
    const std::string text = header_text(order), words = "orthonormal rows, det R = +1";
    const std::size_t function = text.find(" void " + kernel + "(const T* R, ");
    if (function == std::string::npos)
        throw std::runtime_error(fmt::format("order {}: the header has no {}", order, kernel));
    const std::size_t place = text.rfind(words, function), comment = text.rfind("}\n", function);
    if (place == std::string::npos || (comment != std::string::npos && place < comment))
        throw std::runtime_error(fmt::format("order {}: no word on det R above {}", order, kernel));
    return text.compare(place + words.size(), 6, " or -1") == 0;
}

Cost cost(int order, const std::string& kernel) {
    const std::string text = banner_text(order), counts = R"((\d+ mul \d+ add \d+ fma \d+ other))";
    const std::smatch match =
        find(order, kernel, text, " " + kernel + " " + counts + R"(;\s+//\s+per extra vector )" + counts);
    return {match[1], match[2]};
}

}  // namespace zonal::banner
