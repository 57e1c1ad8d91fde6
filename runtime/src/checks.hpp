#pragma once

#include <cstddef>

namespace zonal {

/// Largest order the basis is tested for.
inline constexpr int kMaxOrder = 20;

/// Throws zonal::Error unless 1 <= order <= kMaxOrder.
void check_order(int order);

/// Throws zonal::Error unless `length` = order^2; `field` names the span in the message.
void check_length(const char* field, int order, std::size_t length);

}  // namespace zonal
