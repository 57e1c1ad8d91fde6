#include "apps/emit_jobs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "io/user_error.hpp"
#include "kernels/order_kernels.hpp"
#include "program/numbers.hpp"

namespace zonal {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts;
    std::size_t start = 0;
    for (auto end = text.find(separator); end != std::string::npos; end = text.find(separator, start)) {
        parts.push_back(text.substr(start, end - start));
        start = end + 1;
    }
    parts.push_back(text.substr(start));
    return parts;
}

std::set<int> orders_of(const std::string& option, const std::string& text, char separator) {
    std::set<int> orders;
    for (const std::string& part : split(text, separator)) {
        const auto dash = part.find('-');
        const auto known = program::from_to(kSmallestOrder, kLargestOrder);
        const std::optional<int> first = program::number_in(part.substr(0, dash), known);
        const std::optional<int> last =
            dash == std::string::npos ? first : program::number_in(part.substr(dash + 1), known);
        if (!first || !last || *first > *last)
            throw UserError(fmt::format("{}: found '{}', wanted orders from {} to {}, such as 3-6{}8", option,
                                        part, kSmallestOrder, kLargestOrder, separator));
        for (int order = *first; order <= *last; ++order) orders.insert(order);
    }
    return orders;
}

EmitJobs emit_jobs(const std::set<int>& orders, const std::string& languages,
                   const std::function<void(const std::string&)>& check_language) {
    EmitJobs jobs;
    for (const std::string& part : split(languages, ',')) {
        const auto colon = part.find(':');
        const std::string language = part.substr(0, colon);
        check_language(language);
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
