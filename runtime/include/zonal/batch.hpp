#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "zonal/api.hpp"
#include "zonal/rotation.hpp"

namespace zonal {

/// How the values of one vector lie when it has several channels.
enum class ChannelArrangement {
    interleaved,    ///< [coefficient][channel], as RGB probes have it
    channel_major,  ///< [channel][coefficient], as 3D Gaussian splats have it (f_rest)
};

/// Where the vectors of a batch lie. The same layout serves input and output.
/// Vector k begins at data + k * stride and has channels * coefficients values without gaps, where
/// coefficients = N^2, or N^2 - 1 when `dc_apart`.
struct BatchLayout {
    std::size_t count = 0;   ///< vectors; 0 is allowed and does nothing
    std::size_t stride = 0;  ///< values from one vector to the next; 0: they touch
    int channels = 1;
    ChannelArrangement arrangement = ChannelArrangement::interleaved;
    /// Band 0 is stored elsewhere (no rotation changes it): coefficient l(l+1)+m is at index l(l+1)+m-1.
    bool dc_apart = false;
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
};

/// A batch of unit quaternions: four values each in the order x, y, z, w (w is the real part), as
/// Eigen::Quaternion stores them. q and -q are the same rotation. Precondition: of unit norm within what the
/// caller can bear; a norm of 1 + e costs an error of about 2 (N-1) e.
template <class T>
struct RotationQuaternions {
    std::span<const T> values;
    std::size_t stride = 4;  ///< values from one quaternion to the next, at least 4

    RotationQuaternions() = default;
    explicit RotationQuaternions(std::span<const T> four_values_each, std::size_t stride_in_values = 4)
        : values(four_values_each), stride(stride_in_values) {}
};

/// Where a batch runs when the caller wants more than the calling thread: calls body(begin, end) for ranges
/// of vectors that together are 0 ... count, each once, in any order and on any threads, and returns when all
/// are done. `zonal::on_all_cores` (zonal/parallel.hpp) does so by oneTBB. Ranges of some thousand values
/// each pay.
using Executor = std::function<void(std::size_t count,
                                    const std::function<void(std::size_t begin, std::size_t end)>& body)>;

/// Rotates every vector of a batch by a rotation of its own, all channels of a vector alike.
/// order     : number of bands N; N^2 coefficients, index l(l+1)+m, real orthonormal basis, no
///             Condon-Shortley sign, z polar.
/// rotations : one for each vector, vector k by rotation k; they rotate the function, f'(w) = f(R^T w).
///             Matrices may be mirrors (determinant -1). Precondition: orthonormal (see checked_rotation).
/// in, out   : as `layout` says; they may be the same span, else they must not overlap. Values between the
///             vectors are not touched. No alignment is needed.
///             A NaN or infinity stays within its vector, channel and band; in a rotation, within its vector.
/// Errors    : zonal::Error when the order is not compiled in, the layout contradicts itself, a span is too
///             short for the layout, or `in`, `out` and `rotations` overlap otherwise than as said; `out` is
///             then untouched.
/// Accuracy  : as `rotate`, see zonal/orderNN/rotate.hpp; results may differ from it in the last bits, and
///             from one processor to another.
/// executor  : none: the calling thread does all.
/// Cost      : no allocation; SIMD packs of 4 to 16 vectors chosen for the processor at run time.
///             Batches of more than 32 MiB without gaps, not in place, are written past the caches.
ZONAL_API void rotate_each(int order, const RotationMatrices<float>& rotations, const BatchLayout& layout,
                           std::span<const float> in, std::span<float> out, const Executor& executor = {});
ZONAL_API void rotate_each(int order, const RotationMatrices<double>& rotations, const BatchLayout& layout,
                           std::span<const double> in, std::span<double> out, const Executor& executor = {});
ZONAL_API void rotate_each(int order, const RotationQuaternions<float>& rotations, const BatchLayout& layout,
                           std::span<const float> in, std::span<float> out, const Executor& executor = {});
ZONAL_API void rotate_each(int order, const RotationQuaternions<double>& rotations, const BatchLayout& layout,
                           std::span<const double> in, std::span<double> out, const Executor& executor = {});

/// Rotates every vector of a batch by one rotation; what depends on the rotation only is computed once.
/// All else as in `rotate_each`; a NaN or infinity in the rotation spoils every vector. Three interleaved
/// channels of float are as accurate as `blocks` in orders 3 to 6 where there is SSE4 or NEON.
ZONAL_API void rotate_all(int order, const RotationMatrix<float>& rotation, const BatchLayout& layout,
                          std::span<const float> in, std::span<float> out, const Executor& executor = {});
ZONAL_API void rotate_all(int order, const RotationMatrix<double>& rotation, const BatchLayout& layout,
                          std::span<const double> in, std::span<double> out, const Executor& executor = {});

}  // namespace zonal
