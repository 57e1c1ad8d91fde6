#pragma once

// One entry for vectors of one channel and of three interleaved ones.

#include <span>

#include "zonal/rgb.hpp"

namespace zonal {

/// Calls body(in, out) with spans of T, or of colours where both have 3 order^2 values. That is no square, so
/// that no vector of another order is taken for colours.
template <class T, class Body>
void call_with_channels(int order, std::span<const T> in, std::span<T> out, const Body& body) {
    static_assert(sizeof(Rgb<T>) == 3 * sizeof(T));
    const std::size_t colours = in.size() / 3;
    if (order < 1 || in.size() != out.size() || in.size() % 3 != 0 ||
        colours != static_cast<std::size_t>(order) * static_cast<std::size_t>(order))
        return body(in, out);
    body(std::span(reinterpret_cast<const Rgb<T>*>(in.data()), colours),
         std::span(reinterpret_cast<Rgb<T>*>(out.data()), colours));
}

}  // namespace zonal
