#pragma once

// Numbers that a person types, read in one way by every program: decimal whatever zeros they begin with, the
// whole text, within limits that the message and --help name; never NaN or infinity.

#include <CLI/CLI.hpp>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace zonal::program {

/// The numbers that an option takes.
template <class T>
struct Limits {
    T least = std::numeric_limits<T>::lowest();
    T most = std::numeric_limits<T>::max();
    bool is_above_least = false;  ///< `least` itself is too small

    /// "a whole number from 3 to 20"
    std::string text() const;
};

template <class T>
Limits<T> from_to(T least, T most) {
    return {least, most};
}
template <class T>
Limits<T> at_least(T least) {
    return {.least = least};
}
inline Limits<double> above(double least, double most) { return {least, most, true}; }

/// The number that a text is; nothing where it is none or lies outside. T: int, std::uint64_t or double.
template <class T>
std::optional<T> number_in(std::string_view text, const Limits<T>& limits = {});

/// "found '3x', wanted a whole number from 3 to 20"
template <class T>
std::string complaint(std::string_view text, const Limits<T>& limits);

namespace detail {

template <class T>
T number_of(const std::string& option, const std::string& text, const Limits<T>& limits) {
    const std::optional<T> number = number_in(text, limits);
    if (!number) throw CLI::ValidationError(option, complaint(text, limits));
    return *number;
}

template <class T>
std::string description_of(const std::string& description, const Limits<T>& limits) {
    return description + " (" + limits.text() + ")";
}

}  // namespace detail

/// An option that takes a number.
template <class T>
CLI::Option* add_number(CLI::App& app, const std::string& name, T& value, const Limits<T>& limits,
                        const std::string& description) {
    const auto read = [name, &value, limits](const CLI::results_t& texts) {
        value = detail::number_of(name, texts.at(0), limits);
        return true;
    };
    const auto standard = [&value] { return CLI::detail::to_string(value); };
    return app.add_option(name, read, detail::description_of(description, limits), false, standard)
        ->type_name("NUMBER");
}

/// One that may be left out, and is then nothing.
template <class T>
CLI::Option* add_number(CLI::App& app, const std::string& name, std::optional<T>& value,
                        const Limits<T>& limits, const std::string& description) {
    const auto read = [name, &value, limits](const CLI::results_t& texts) {
        value = detail::number_of(name, texts.at(0), limits);
        return true;
    };
    return app.add_option(name, read, detail::description_of(description, limits))->type_name("NUMBER");
}

/// One that takes several, one at least unless `expected` says otherwise.
template <class T>
CLI::Option* add_numbers(CLI::App& app, const std::string& name, std::vector<T>& values,
                         const Limits<T>& limits, const std::string& description) {
    const auto read = [name, &values, limits](const CLI::results_t& texts) {
        values.clear();
        for (const std::string& text : texts) values.push_back(detail::number_of(name, text, limits));
        return true;
    };
    const auto standard = [&values] { return CLI::detail::join(values, " "); };
    return app.add_option(name, read, detail::description_of(description, limits), false, standard)
        ->type_name("NUMBER")
        ->expected(1, CLI::detail::expected_max_vector_size)
        ->allow_extra_args();  // else CLI11 takes the fewest
}

}  // namespace zonal::program
