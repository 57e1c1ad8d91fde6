#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "zonal/api.hpp"
#include "zonal/rgb.hpp"
#include "zonal/rotation.hpp"

namespace zonal {

/// How other libraries write SH vectors and rotations. Each enumerator says in what it differs from ours:
/// real, orthonormal, index l(l+1)+m, no Condon-Shortley sign, z polar, R on column vectors, any order. The
/// values are the coefficients of a sum of the convention's basis functions; ambisonic channels are the gains
/// of encoded sources: one of gain g in direction d is g y_l^m(d) in our basis, an impulse cut off in band.
/// Coordinates are never renamed: x, y, z are the convention's own, whichever of them points up.
enum class Convention {
    kGaussianSplatting,  ///< "3dgs", "khr_gaussian_splatting": Condon-Shortley sign (-1)^m
    kDirectX,            ///< "directx": sign (-1)^m; a matrix M multiplies rows, v' = v M, as XMMATRIX does
    kGoogle,             ///< "google" (google/spherical-harmonics): sign (-1)^m
    kAmbixSn3d,          ///< "ambix_sn3d": ACN channels, each sqrt(4 pi / (2l+1)) times ours
    kAmbixN3d,           ///< "ambix_n3d": ACN channels, each sqrt(4 pi) times ours
    kFuMa,               ///< "fuma", orders 1 to 4: W X Y Z R S T U V K L M N O P Q, maxN, W / sqrt(2)
    kUnityL2,            ///< "unity_l2", order 3: SphericalHarmonicsL2, ours times the basis constants
    kThreeJs,            ///< "threejs", order 3: SphericalHarmonics3, as ours
    kE3nn,               ///< "e3nn", normalization 'integral': y polar, so l = 1 is (x, y, z)
};

/// The convention of that name (see Convention). Errors: zonal::Error names the value and the valid names.
ZONAL_API Convention convention_from_name(std::string_view name);

/// All valid names, `3dgs` and its alias `khr_gaussian_splatting` both.
ZONAL_API std::vector<std::string_view> convention_names();

/// The matrix that makes a kernel of ours rotate the convention's coefficients as they are:
/// `rotate(order, kernel_rotation(convention, R), in, out)` equals `rotate(convention, order, R, in, out)`
/// for every convention but fuma and unity_l2, whose scales vary within a band.
/// R       : in the convention's own form and axes. T is float or double.
/// Result  : P R P^T, P a signed permutation of the axes; of R^T for directx. Exact.
/// Beware  : not for vectors that went through to_zonal; those rotate by R itself (by M^T for directx).
template <class T>
ZONAL_API RotationMatrix<T> kernel_rotation(Convention convention, const RotationMatrix<T>& rotation);

/// Converts one signal into our basis: the same function of the same (x, y, z), so that `evaluate` applies.
/// in, out  : order^2 values each; the same span, or separate ones.
/// Errors   : zonal::Error when the convention does not have the order, a span has the wrong length, the
///            spans overlap in part, or, for e3nn, the order is not among compiled_orders(); `out` is then
///            untouched.
/// Accuracy : a rounded factor and a rounded product a value, 3/2 epsilons; exact where the factor is 1
///            or -1; e3nn: that of zonal::rotate, which rotates the polar axis.
/// Cost     : one multiplication a value; e3nn: one rotation. A NaN or infinity stays in its coefficient
///            (e3nn: in its band).
ZONAL_API void to_zonal(Convention convention, int order, std::span<const float> in, std::span<float> out);
ZONAL_API void to_zonal(Convention convention, int order, std::span<const double> in, std::span<double> out);
ZONAL_API void to_zonal(Convention convention, int order, std::span<const Rgb<float>> in,
                        std::span<Rgb<float>> out);
ZONAL_API void to_zonal(Convention convention, int order, std::span<const Rgb<double>> in,
                        std::span<Rgb<double>> out);

/// The inverse of to_zonal, with the same contract.
ZONAL_API void from_zonal(Convention convention, int order, std::span<const float> in, std::span<float> out);
ZONAL_API void from_zonal(Convention convention, int order, std::span<const double> in,
                          std::span<double> out);
ZONAL_API void from_zonal(Convention convention, int order, std::span<const Rgb<float>> in,
                          std::span<Rgb<float>> out);
ZONAL_API void from_zonal(Convention convention, int order, std::span<const Rgb<double>> in,
                          std::span<Rgb<double>> out);

/// Rotates one signal given in a convention by a matrix given in that convention; the result is in it too.
/// The function rotates: f'(w) = f(R^T w), where R acts on columns (directx: R = M^T); mirrors are allowed.
/// in, out  : order^2 values each, or 3 order^2, three interleaved channels; the same span, or separate ones.
/// Errors   : zonal::Error when the convention does not have the order, the order is not among
///            compiled_orders(), a span has the wrong length, or the spans overlap in part; `out` is then
///            untouched.
/// Accuracy and cost: those of zonal::rotate, for the change of R is exact. fuma and unity_l2 add two
///            multiplications a value, of 3/2 epsilons each.
ZONAL_API void rotate(Convention convention, int order, const RotationMatrix<float>& rotation,
                      std::span<const float> in, std::span<float> out);
ZONAL_API void rotate(Convention convention, int order, const RotationMatrix<double>& rotation,
                      std::span<const double> in, std::span<double> out);
ZONAL_API void rotate(Convention convention, int order, const RotationMatrix<float>& rotation,
                      std::span<const Rgb<float>> in, std::span<Rgb<float>> out);
ZONAL_API void rotate(Convention convention, int order, const RotationMatrix<double>& rotation,
                      std::span<const Rgb<double>> in, std::span<Rgb<double>> out);

}  // namespace zonal
