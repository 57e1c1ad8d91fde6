#pragma once

// JSON that somebody else may have written: what it says is taken as it stands, or not at all.

#include <array>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace zonal {

using Json = nlohmann::ordered_json;

/// A value that is not what was wanted; `as` throws it.
struct WrongJson : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// Throws `WrongJson` that says where the text breaks, or is nested deeper than any file of this program:
/// what reads or prints a value calls itself for every level.
Json parse_json(const std::string& text);

/// The value for a message, cut where it is long.
std::string shown_value(const Json& value);

namespace detail {

template <class T>
struct As;

}  // namespace detail

/// The value as a T: whole numbers are written as such and fit, arrays have their length, and nothing stands
/// for a value of another kind. Throws `WrongJson`.
template <class T>
T as(const Json& value) {
    return detail::As<T>::of(value);
}

namespace detail {

inline void require(bool is_right, const Json& value) {
    if (!is_right) throw WrongJson(shown_value(value));
}

template <class T>
requires std::is_integral_v<T>
struct As<T> {
    static T of(const Json& value) {
        require(value.is_number_integer(), value);
        const bool fits = value.is_number_unsigned() ? std::in_range<T>(value.get<std::uint64_t>())
                                                     : std::in_range<T>(value.get<std::int64_t>());
        require(fits, value);
        return value.get<T>();
    }
};

template <>
struct As<double> {
    static double of(const Json& value) {
        require(value.is_number() && std::isfinite(value.get<double>()), value);
        return value.get<double>();
    }
};

template <>
struct As<std::string> {
    static std::string of(const Json& value) {
        require(value.is_string(), value);
        return value.get<std::string>();
    }
};

template <class T>
struct As<std::vector<T>> {
    static std::vector<T> of(const Json& value) {
        require(value.is_array(), value);
        std::vector<T> items;
        for (const Json& item : value) items.push_back(as<T>(item));
        return items;
    }
};

template <>
struct As<std::vector<Json>> {
    static std::vector<Json> of(const Json& value) {
        require(value.is_array(), value);
        return {value.begin(), value.end()};
    }
};

template <class T, std::size_t N>
struct As<std::array<T, N>> {
    static std::array<T, N> of(const Json& value) {
        require(value.is_array() && value.size() == N, value);
        std::array<T, N> items;
        for (std::size_t k = 0; k < N; ++k) items[k] = as<T>(value[k]);
        return items;
    }
};

}  // namespace detail

/// A field of an object. `complain(found)` ends with an exception where it is missing or of another kind.
template <class T, class Complain>
T field_as(const Json& object, const char* name, const Complain& complain) {
    if (!object.is_object() || !object.contains(name)) complain("nothing");
    try {
        return as<T>(object.at(name));
    } catch (const WrongJson& wrong) {
        complain(wrong.what());
    }
    throw std::logic_error("a complaint that returned");
}

}  // namespace zonal
