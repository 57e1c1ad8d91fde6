#include "support/banner.hpp"

#include <fmt/format.h>

#include <fstream>
#include <regex>
#include <sstream>

namespace zonal::banner {

namespace {

std::string text_of(int order, const std::string& kernel) {
    const std::string file = std::regex_replace(kernel, std::regex("::"), "_");
    std::ifstream stream(fmt::format("{}/zonal/order{:02}/{}.hpp", ZONAL_GENERATED_DIR, order, file));
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

std::smatch find(int order, const std::string& kernel, const std::string& text, const std::string& pattern) {
    std::smatch match;
    if (!std::regex_search(text, match, std::regex(pattern)))
        throw std::runtime_error(fmt::format("order {}: the header of {} does not state it", order, kernel));
    return match;
}

}  // namespace

Bound bound(int order, const std::string& kernel) {
    const std::string text = text_of(order, kernel);
    const std::smatch match = find(order, kernel, text,
                                   R"(bound   : ([0-9.e+-]+) \(float\), ([0-9.e+-]+) \(double\), with fused )"
                                   R"(instructions, for det R = \+1( or -1)?;\s+//\s+relative to \|f\|; )"
                                   R"(([0-9.]+) )");
    return {std::stod(match[1]), std::stod(match[2]), std::stod(match[4]), match[3].matched};
}

Cost cost(int order, const std::string& kernel) {
    const std::string text = text_of(order, kernel), counts = R"((\d+ mul \d+ add \d+ fma \d+ other))";
    const std::smatch match =
        find(order, kernel, text, "cost    : " + counts + R"(;\s+//\s+per extra vector )" + counts);
    return {match[1], match[2]};
}

}  // namespace zonal::banner
