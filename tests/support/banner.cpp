#include "support/banner.hpp"

#include <fmt/format.h>

#include <fstream>
#include <regex>
#include <sstream>

namespace zonal::banner {

namespace {

std::string text_of(int order, const std::string& kernel, const std::string& folder = ZONAL_GENERATED_DIR) {
    const std::string file = std::regex_replace(kernel, std::regex("::"), "_");
    std::ifstream stream(fmt::format("{}/zonal/order{:02}/{}.hpp", folder, order, file));
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// The header's first comment: expressions take long to find in all of it.
std::string banner_text(int order, const std::string& kernel,
                        const std::string& folder = ZONAL_GENERATED_DIR) {
    const std::string text = text_of(order, kernel, folder);
    return text.substr(0, text.find("#pragma once"));
}

std::smatch find(int order, const std::string& kernel, const std::string& text, const std::string& pattern) {
    std::smatch match;
    if (!std::regex_search(text, match, std::regex(pattern)))
        throw std::runtime_error(fmt::format("order {}: the header of {} does not state it", order, kernel));
    return match;
}

}  // namespace

Bound bound(int order, const std::string& kernel) {
    const std::string text = banner_text(order, kernel);
    const std::smatch match =
        find(order, kernel, text,
             R"(bound   : ([0-9.e+-]+) \(float\), ([0-9.e+-]+) \(double\), with fused )"
             R"(instructions, for det R = \+1( or -1)?;\s+//\s+([0-9.e+-]+), ([0-9.e+-]+) )"
             R"(without them; [^|]*relative to \|f\|; )"
             R"(([0-9.]+) )");
    return {std::stod(match[1]), std::stod(match[2]), std::stod(match[4]),
            std::stod(match[5]), std::stod(match[6]), match[3].matched};
}

double float_bound_of_channels(int order, const std::string& kernel) {
    return std::stod(
        find(order, kernel, banner_text(order, kernel), R"(channels: ([0-9.e+-]+) \(float\))")[1]);
}

bool comment_takes_mirrors(int order, const std::string& kernel) {
    const std::string text = text_of(order, kernel), words = "orthonormal rows, det R = +1";
    const std::size_t place = text.find(words);
    if (place == std::string::npos || place > text.find(" void "))
        throw std::runtime_error(fmt::format("order {}: no word on det R above {}", order, kernel));
    return text.compare(place + words.size(), 6, " or -1") == 0;
}

Cost cost(int order, const std::string& kernel) { return cost_in(ZONAL_GENERATED_DIR, order, kernel); }

Cost cost_in(const std::string& folder, int order, const std::string& kernel) {
    const std::string text = banner_text(order, kernel, folder),
                      counts = R"((\d+ mul \d+ add \d+ fma \d+ other))";
    const std::smatch match =
        find(order, kernel, text, "cost    : " + counts + R"(;\s+//\s+per extra vector )" + counts);
    return {match[1], match[2]};
}

}  // namespace zonal::banner
