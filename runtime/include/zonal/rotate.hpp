#pragma once

#include <span>

#include "zonal/api.hpp"
#include "zonal/rgb.hpp"
#include "zonal/rotation.hpp"

namespace zonal {

/// The orders that `rotate` accepts, ascending: those of ZONAL_ORDERS when the library was configured.
ZONAL_API std::span<const int> compiled_orders();

/// Rotates one SH vector of the given order (order N: N^2 coefficients, degrees 0 to N-1).
/// rotation : rotates the function, f'(w) = f(R^T w); mirrors too (det R = -1).
///            Precondition: orthonormal within what the caller can bear (see checked_rotation).
/// in, out  : N^2 values each, index l(l+1)+m, real orthonormal basis, no Condon-Shortley sign, z polar; or
///            3 N^2, three interleaved channels. Of more vectors or channels see zonal/batch.hpp.
///            They may be the same span; they must not overlap in part. No alignment is needed.
///            A NaN or infinity stays within its band.
/// Errors   : zonal::Error when the order is not compiled in, a span has the wrong length, or the spans
///            overlap in part; `out` is then untouched.
/// Accuracy and cost: those of `zonal::orderN::rotate` (of three channels: `rotate_channels`, where there is
/// one), see zonal/orderNN/rotate.hpp, which has bounds with fused instructions and without.
ZONAL_API void rotate(int order, const RotationMatrix<float>& rotation, std::span<const float> in,
                      std::span<float> out);
ZONAL_API void rotate(int order, const RotationMatrix<double>& rotation, std::span<const double> in,
                      std::span<double> out);

/// The same for three channels; what depends on the rotation only is computed once.
ZONAL_API void rotate(int order, const RotationMatrix<float>& rotation, std::span<const Rgb<float>> in,
                      std::span<Rgb<float>> out);
ZONAL_API void rotate(int order, const RotationMatrix<double>& rotation, std::span<const Rgb<double>> in,
                      std::span<Rgb<double>> out);

}  // namespace zonal
