#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "zonal/api.hpp"
#include "zonal/conventions.hpp"
#include "zonal/rgb.hpp"
#include "zonal/rotation.hpp"

namespace zonal {

/// How the values of one vector lie when it has several channels.
enum class ChannelArrangement {
    interleaved,    ///< [coefficient][channel], as RGB probes have it
    channel_major,  ///< [channel][coefficient], as 3D Gaussian splats have it (f_rest)
};

/// Where the vectors of a batch lie, one after the other. The same layout serves input and output.
/// Vector k begins at data + k * stride and has channels * coefficients values without gaps, where
/// coefficients = N^2, or N^2 - 1 when `dc_apart`.
struct BatchLayout {
    std::size_t count = 0;   ///< vectors; 0 is allowed and does nothing
    std::size_t stride = 0;  ///< values from one vector to the next; 0: they touch
    int channels = 1;
    ChannelArrangement arrangement = ChannelArrangement::interleaved;
    /// Band 0 is stored elsewhere (no rotation changes it): coefficient l(l+1)+m is at index l(l+1)+m-1.
    bool dc_apart = false;
    std::size_t out_stride = 0;  ///< of the output, where it is another; 0: as `stride`
    /// Whose vectors and rotations these are, input and output alike; none: ours, see rotate_each. Rotations
    /// are in the convention's own form, as for `rotate(convention, ...)`; quaternions always of the rotation
    /// on columns.
    std::optional<Convention> convention = {};
};

/// Where the vectors of a planar batch lie: one array (plane) a coefficient, as audio buffers and the
/// accessors of glTF have them. Vector k has its channels at k * stride ... k * stride + channels - 1 of each
/// plane.
struct PlanarLayout {
    std::size_t count = 0;       ///< vectors (of audio: frames); 0 is allowed and does nothing
    int channels = 1;            ///< that touch in a plane, as three of a colour do
    bool dc_apart = false;       ///< as in BatchLayout: planes are those of coefficients from 1 on
    std::size_t stride = 0;      ///< values from one vector to the next in a plane; 0: they touch
    std::size_t out_stride = 0;  ///< of the output, where it is another; 0: as `stride`
    std::optional<Convention> convention = {};  ///< as in BatchLayout
};

/// The planes of a planar batch, in the order of coefficients. T is float or double, const for input.
template <class T>
class Planes {
  public:
    /// A pointer to each: `std::span(buffer.getArrayOfReadPointers(), 16)`. Their lengths are not known:
    /// precondition: (count - 1) * stride + channels values each.
    explicit Planes(std::span<T* const> pointers) : pointers_(pointers) {}
    /// One after the other: plane i begins at values[i * stride].
    Planes(std::span<T> values, std::size_t stride) : values_(values), stride_(stride) {}

    std::span<T* const> pointers() const { return pointers_; }
    std::span<T> values() const { return values_; }
    std::size_t stride() const { return stride_; }
    /// Whether each has a pointer of its own.
    bool are_pointers() const { return values_.data() == nullptr; }

  private:
    std::span<T* const> pointers_;
    std::span<T> values_;
    std::size_t stride_ = 0;
};

/// A batch of rotation matrices: nine values each, row-major, as RotationMatrix has them.
template <class T>
struct RotationMatrices {
    std::span<const T> values;
    std::size_t stride = 9;  ///< values from one matrix to the next, at least 9

    RotationMatrices() = default;
    explicit RotationMatrices(std::span<const T> nine_values_each, std::size_t stride_in_values = 9)
        : values(nine_values_each), stride(stride_in_values) {}
    RotationMatrices(std::span<const RotationMatrix<T>> matrices)
        : values(reinterpret_cast<const T*>(matrices.data()), 9 * matrices.size()) {
        static_assert(sizeof(RotationMatrix<T>) == 9 * sizeof(T));
    }
    RotationMatrices(const std::vector<RotationMatrix<T>>& matrices)
        : RotationMatrices(std::span<const RotationMatrix<T>>(matrices)) {}
};

/// Where the real part w of a quaternion w + x i + y j + z k is stored.
enum class QuaternionOrder {
    xyzw,  ///< last: Eigen, glTF, most engines
    wxyz,  ///< first: 3D Gaussian splats (rot_0 ... rot_3), head trackers
};

/// A batch of unit quaternions, four values each. q and -q are the same rotation. Precondition: of unit norm
/// within what the caller can bear; a norm of 1 + e costs an error of at most 8 sqrt(2) |e| times the excess
/// that kernels state: (N-1)/2 or little more, but 2.3 at orders 3 and 4.
template <class T>
struct RotationQuaternions {
    std::span<const T> values;
    std::size_t stride = 4;  ///< values from one quaternion to the next, at least 4
    QuaternionOrder order = QuaternionOrder::xyzw;

    RotationQuaternions() = default;
    explicit RotationQuaternions(std::span<const T> four_values_each, std::size_t stride_in_values = 4,
                                 QuaternionOrder order_of_values = QuaternionOrder::xyzw)
        : values(four_values_each), stride(stride_in_values), order(order_of_values) {}

    static RotationQuaternions xyzw(std::span<const T> four_values_each, std::size_t stride_in_values = 4) {
        return RotationQuaternions(four_values_each, stride_in_values, QuaternionOrder::xyzw);
    }
    static RotationQuaternions wxyz(std::span<const T> four_values_each, std::size_t stride_in_values = 4) {
        return RotationQuaternions(four_values_each, stride_in_values, QuaternionOrder::wxyz);
    }
};

/// Where a batch runs when the caller wants more than the calling thread: calls body(begin, end) for ranges
/// of vectors that together are 0 ... count, each once, in any order and on any threads, and returns when all
/// are done. `zonal::on_all_cores` (zonal/parallel.hpp) does so by oneTBB. Ranges of some thousand values
/// each pay.
using Executor = std::function<void(std::size_t count,
                                    const std::function<void(std::size_t begin, std::size_t end)>& body)>;

/// Rotates every vector of a batch by a rotation of its own, all channels of a vector alike.
/// order     : number of bands N; N^2 coefficients, index l(l+1)+m, real orthonormal basis, no
///             Condon-Shortley sign, z polar, where the layout names no other convention.
/// rotations : one for each vector, vector k by rotation k; they rotate the function, f'(w) = f(R^T w).
///             Matrices may be mirrors (determinant -1). Precondition: orthonormal (see checked_rotation).
/// in, out   : as `layout` says; they may be the same (with one stride), else they must not overlap. Values
///             between the vectors are not touched. Addresses are those of whole values, as every span of T
///             has them; vectors of bytes read from a file may begin elsewhere, and are refused.
///             A NaN or infinity stays within its vector, channel and band; in a rotation, within its vector.
/// Errors    : zonal::Error when the order is not compiled in or the convention does not have it, the layout
///             contradicts itself, a span is too short for the layout, an address is none of a T, or `in`,
///             `out` and `rotations` overlap otherwise than as said; `out` is then untouched. Also when an
///             executor hands out a range outside of the batch, which is not turned, or not as many vectors
///             as there are.
/// Accuracy  : as `rotate`, see zonal/orderNN/rotate.hpp; results may differ from it in the last bits, and
///             from one processor to another, but not with the place of a vector in the batch. fuma and
///             unity_l2 add two multiplications a value.
/// executor  : none: the calling thread does all.
/// Cost      : no allocation, at most 64 KiB of stack up to order 10 (optimised); SIMD packs of 4 to 16
/// values chosen for
///             the processor at run time. A lane is a vector; interleaved channels from 8 or 16 on are lanes
///             themselves. Batches of more than 32 MiB without gaps, not in place and not planar, are written
///             past the caches.
ZONAL_API void rotate_each(int order, const RotationMatrices<float>& rotations, const BatchLayout& layout,
                           std::span<const float> in, std::span<float> out, const Executor& executor = {});
ZONAL_API void rotate_each(int order, const RotationMatrices<double>& rotations, const BatchLayout& layout,
                           std::span<const double> in, std::span<double> out, const Executor& executor = {});
ZONAL_API void rotate_each(int order, const RotationQuaternions<float>& rotations, const BatchLayout& layout,
                           std::span<const float> in, std::span<float> out, const Executor& executor = {});
ZONAL_API void rotate_each(int order, const RotationQuaternions<double>& rotations, const BatchLayout& layout,
                           std::span<const double> in, std::span<double> out, const Executor& executor = {});

/// Rotates every vector of a batch by one rotation; what depends on the rotation only is computed once.
/// All else as in `rotate_each`; a NaN or infinity in the rotation spoils every vector. Interleaved channels
/// of float, 2 to 63, are as accurate as `blocks` in orders 3 to 6 where there is SSE4 or NEON.
ZONAL_API void rotate_all(int order, const RotationMatrix<float>& rotation, const BatchLayout& layout,
                          std::span<const float> in, std::span<float> out, const Executor& executor = {});
ZONAL_API void rotate_all(int order, const RotationMatrix<double>& rotation, const BatchLayout& layout,
                          std::span<const double> in, std::span<double> out, const Executor& executor = {});

/// The same of planar vectors; nothing is transposed. `in` and `out` may have the same planes, in the same
/// order and with one stride; else no plane of `out` may overlap another one.
/// Errors also : a number of planes that is not that of the coefficients.
ZONAL_API void rotate_each(int order, const RotationMatrices<float>& rotations, const PlanarLayout& layout,
                           const Planes<const float>& in, const Planes<float>& out,
                           const Executor& executor = {});
ZONAL_API void rotate_each(int order, const RotationMatrices<double>& rotations, const PlanarLayout& layout,
                           const Planes<const double>& in, const Planes<double>& out,
                           const Executor& executor = {});
ZONAL_API void rotate_each(int order, const RotationQuaternions<float>& rotations, const PlanarLayout& layout,
                           const Planes<const float>& in, const Planes<float>& out,
                           const Executor& executor = {});
ZONAL_API void rotate_each(int order, const RotationQuaternions<double>& rotations,
                           const PlanarLayout& layout, const Planes<const double>& in,
                           const Planes<double>& out, const Executor& executor = {});
ZONAL_API void rotate_all(int order, const RotationMatrix<float>& rotation, const PlanarLayout& layout,
                          const Planes<const float>& in, const Planes<float>& out,
                          const Executor& executor = {});
ZONAL_API void rotate_all(int order, const RotationMatrix<double>& rotation, const PlanarLayout& layout,
                          const Planes<const double>& in, const Planes<double>& out,
                          const Executor& executor = {});

/// The values of colours, three each: what a call with a layout of three interleaved channels takes.
template <class T>
std::span<T> values_of(std::span<Rgb<T>> colours) {
    static_assert(sizeof(Rgb<T>) == 3 * sizeof(T));
    return {reinterpret_cast<T*>(colours.data()), 3 * colours.size()};
}
template <class T>
std::span<const T> values_of(std::span<const Rgb<T>> colours) {
    static_assert(sizeof(Rgb<T>) == 3 * sizeof(T));
    return {reinterpret_cast<const T*>(colours.data()), 3 * colours.size()};
}

/// The same of vectors of colours that touch, N^2 colours each: as many as `in` has, of which `out` has as
/// many.
ZONAL_API void rotate_each(int order, const RotationMatrices<float>& rotations,
                           std::span<const Rgb<float>> in, std::span<Rgb<float>> out,
                           const Executor& executor = {});
ZONAL_API void rotate_each(int order, const RotationMatrices<double>& rotations,
                           std::span<const Rgb<double>> in, std::span<Rgb<double>> out,
                           const Executor& executor = {});
ZONAL_API void rotate_each(int order, const RotationQuaternions<float>& rotations,
                           std::span<const Rgb<float>> in, std::span<Rgb<float>> out,
                           const Executor& executor = {});
ZONAL_API void rotate_each(int order, const RotationQuaternions<double>& rotations,
                           std::span<const Rgb<double>> in, std::span<Rgb<double>> out,
                           const Executor& executor = {});
ZONAL_API void rotate_all(int order, const RotationMatrix<float>& rotation, std::span<const Rgb<float>> in,
                          std::span<Rgb<float>> out, const Executor& executor = {});
ZONAL_API void rotate_all(int order, const RotationMatrix<double>& rotation, std::span<const Rgb<double>> in,
                          std::span<Rgb<double>> out, const Executor& executor = {});

}  // namespace zonal
