#pragma once

#include <vector>

namespace zonal::baselines {

/// Dense blocks of the rotation by +90 degrees about x, all bands below `order`, rounded from long double.
/// That by -90 degrees is the transpose.
template <class T>
std::vector<T> quarter_turn_blocks(int order);

}  // namespace zonal::baselines
