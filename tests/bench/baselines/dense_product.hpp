#pragma once

namespace zonal::baselines {

/// Applies dense blocks to one vector, band by band, by Eigen: the cheapest way to turn many vectors by one
/// rotation that a user of a matrix library has. T is float or double. Allocates nothing.
/// dense  : for l = 0 ... order-1 a row-major (2l+1)^2 block, order (4 order^2 - 1) / 3 values.
/// f, out : order^2 values each, index l(l+1)+m; they must not overlap.
template <class T>
void apply_blocks(int order, const T* dense, const T* f, T* out);

}  // namespace zonal::baselines
