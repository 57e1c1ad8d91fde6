#include "apps/emit_jobs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <optional>
#include <sstream>

#include "io/user_error.hpp"
#include "kernels/order_kernels.hpp"

namespace zonal {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::istringstream stream(text);
    for (std::string part; std::getline(stream, part, separator);) parts.push_back(part);
    return parts;
}

std::optional<int> whole_number(const std::string& text) {
    int number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return number;
}

}  // namespace

std::set<int> orders_of(const std::string& option, const std::string& text, char separator) {
    std::set<int> orders;
    for (const std::string& part : split(text, separator)) {
        const auto dash = part.find('-');
        const auto first = whole_number(part.substr(0, dash));
        const auto last = dash == std::string::npos ? first : whole_number(part.substr(dash + 1));
        if (!first || !last || *first > *last || *first < kSmallestOrder || *last > kLargestOrder)
            throw UserError(fmt::format("{}: found '{}', wanted orders from {} to {}, such as 3-6{}8", option,
                                        part, kSmallestOrder, kLargestOrder, separator));
        for (int order = *first; order <= *last; ++order) orders.insert(order);
    }
    if (orders.empty())
        throw UserError(fmt::format("{}: found '{}', wanted at least one order, such as 3-6{}8", option, text,
                                    separator));
    return orders;
}

EmitJobs emit_jobs(const std::set<int>& orders, const std::string& languages) {
    EmitJobs jobs;
    for (const std::string& part : split(languages, ',')) {
        const auto colon = part.find(':');
        const std::string language = part.substr(0, colon);
        const std::set<int> own =
            colon == std::string::npos
                ? orders
                : orders_of(fmt::format("--languages {}", language), part.substr(colon + 1), '+');
        if (own.empty())
            throw UserError(
                fmt::format("--languages {0}: found no orders, wanted some; say --orders 3-6 or "
                            "{0}:3-6",
                            language));
        for (const int order : own) {
            std::vector<std::string>& of_order = jobs[order];
            if (std::ranges::find(of_order, language) != of_order.end())
                throw UserError(
                    fmt::format("--languages: found '{}' twice, wanted each language once", language));
            of_order.push_back(language);
        }
    }
    return jobs;
}

}  // namespace zonal
