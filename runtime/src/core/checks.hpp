#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "zonal/api.hpp"

namespace zonal {

/// Largest order the basis is tested for.
inline constexpr int kMaxOrder = 20;

/// Throws zonal::Error unless 1 <= order <= kMaxOrder.
ZONAL_API void check_order(int order);

/// Throws zonal::Error unless `length` = order^2; `field` names the span in the message.
ZONAL_API void check_length(const char* field, int order, std::size_t length);

/// The same; says what takes more than one vector or channel.
ZONAL_API void check_rotated_length(const char* field, int order, std::size_t length);

[[noreturn]] ZONAL_API void throw_partial_overlap();

/// Throws zonal::Error unless the spans are the same or apart.
template <class V>
void check_no_partial_overlap(std::span<const V> in, std::span<V> out) {
    const std::less<const V*> before;
    const bool overlaps =
        before(in.data(), out.data() + out.size()) && before(out.data(), in.data() + in.size());
    if (overlaps && in.data() != out.data()) throw_partial_overlap();
}

}  // namespace zonal
