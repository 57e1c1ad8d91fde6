#pragma once

// What `rotate` does behind its checks.

#include "zonal/api.hpp"
#include "zonal/rgb.hpp"
#include "zonal/rotation.hpp"

namespace zonal {

/// Rotates order^2 values, mirrors too, by the kernel of an order that is compiled in. V is T or Rgb<T>;
/// `in` and `out` may be the same.
template <class T, class V>
ZONAL_API void rotate_unchecked(int order, const RotationMatrix<T>& rotation, const V* in, V* out);

}  // namespace zonal
