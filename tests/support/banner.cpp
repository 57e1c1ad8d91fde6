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

}  // namespace

std::string header_text(int order) {
    std::ifstream stream(fmt::format("{}/zonal/order{:02}.hpp", ZONAL_GENERATED_DIR, order));
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

Bound bound(int order, const std::string& kernel) {
    const std::string text = header_text(order);
    const std::smatch match = find(
        order, kernel, text,
        " " + kernel +
            R"( relative error ([0-9.e+-]+) \(float\), ([0-9.e+-]+) \(double\),\s+//\s+for det R = \+1( or -1)?; excess ([0-9.]+))");
    return {std::stod(match[1]), std::stod(match[2]), std::stod(match[4]), match[3].matched};
}

Cost cost(int order, const std::string& kernel) {
    const std::string text = header_text(order), counts = R"((\d+ mul \d+ add \d+ fma \d+ other))";
    const std::smatch match =
        find(order, kernel, text, " " + kernel + " " + counts + R"(;\s+//\s+per extra vector )" + counts);
    return {match[1], match[2]};
}

}  // namespace zonal::banner
