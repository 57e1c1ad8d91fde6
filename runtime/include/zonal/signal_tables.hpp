#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "zonal/api.hpp"
#include "zonal/rgb.hpp"

namespace zonal {

/// Tables for signal-tailored rotation on a GPU: a static signal, looked up where the lobes come from instead
/// of being rotated. `zonal_orderN_rotate_tailored` of the generated shader orderNN/rotate_tailored.glsl
/// reads them.
///
/// An array of cube maps with mip levels holds the expansions f_l(w) = sum_m f_lm y_lm(w) of bands 2 …
/// order-1: layer l - 2 is band l, its texels (red, green, blue, 0). Bands 0 and 1 need no table: the shader
/// rotates their four coefficients. Each band is read at one level of its own, coarser for low bands,
/// bilinear within it.
///
/// Stretched faces: on a face of n texels an edge, column i lies at u = ((2i + 1) / n - 1) / kFaceScale, rows
/// likewise at v, so a face reaches beyond the edges of the cube by at least half a texel at every level. The
/// shader scales the two smaller components of a direction by kFaceScale before it samples: a bilinear filter
/// then never reaches into another face, where the grid bends. (Values at the texels' centres of plain faces
/// are wrong there at first order in the texel.) One scale for all levels lets a shader compiler find face
/// and coordinates of a lobe once for all bands.
///
/// Error. Lines of constant u or v on a face are great circles. On one, f_l is a trigonometric polynomial of
/// degree l, so by Bernstein's inequality its derivatives by angle are at most l M and l² M, M = max |f_l|
/// (at most sqrt((2l + 1) / 4 pi) ||f_l||; a grid gives less). The angle is arctan(u / c) with c >= 1, so the
/// second derivative by u is at most D M, D = max over u of (l² + 2 l u) / (1 + u²)², about l² + 1/2. With
/// texels h = 2 / (kFaceScale n) apart,
///     bilinear interpolation   (h² / 4) D M,
///     coordinates of b subtexel bits, each off by at most 2^-b of a texel   2 · 2^-b h l M,
///     texels rounded to 11 or 24 bits, numbers that are rounded to float on the way
/// add up to an error of each sample, and Â_l turns samples that are off by e into coefficients that are off
/// by at most min(||Â_l||_2 sqrt(2l + 1), || |Â_l| 1 ||_2) e. The plan is made from this bound.
/// Source of the method: Nowrouzezahrai, Simari, Fiume 2012, eq. 11, which leaves the resolution open.

/// Exact in float.
inline constexpr double kFaceScale = 31.0 / 32;
/// Texels along an edge of the smallest faces: half a texel of these is what faces are stretched by.
inline constexpr int kSmallestFace = 32;
/// The first band that is tabulated.
inline constexpr int kFirstTableBand = 2;

struct SignalTableOptions {
    /// Largest error of a rotated signal, its Euclidean norm over all coefficients relative to the signal's.
    double budget = 0;
    /// VkPhysicalDeviceLimits::subTexelPrecisionBits of the device; Vulkan promises 4.
    int subtexel_bits = 8;
    /// VkPhysicalDeviceLimits::maxImageDimensionCube of the device; Vulkan promises 4096.
    int largest_face = 4096;
};

/// Sizes and levels of the tables of one signal, and what they promise.
struct SignalTablePlan {
    int order = 0;
    int face_size = 0;  ///< texels along an edge, at level 0; halved, rounded down, per level
    int level_count = 0;
    std::vector<int> levels;          ///< of each layer: the level to read band l at is levels[l - 2]
    std::vector<double> band_bounds;  ///< of each layer: largest error in band l relative to ||f||
    double bound = 0;                 ///< of the rotated signal, relative to ||f||; at most the budget
    double excess = 0;                ///< what R lacks costs at most this times ||R R^T - I||_F in addition

    int layer_count() const { return order - kFirstTableBand; }
    int size_at(int level) const { return face_size >> level; }
    /// Where a face begins: texels are stored by level, layer, face (+x, -x, +y, -y, +z, -z), row, column. So
    /// a level is one copy from a buffer to 6 layer_count() layers of a Vulkan image.
    ZONAL_API std::size_t first_texel(int level, int layer = 0, int face = 0) const;
    std::size_t texel_count() const { return first_texel(level_count); }
};

/// `T` is what texels are stored in: float (VK_FORMAT_R32G32B32A32_SFLOAT, which a device need not filter) or
/// Eigen::half (VK_FORMAT_R16G16B16A16_SFLOAT).
template <class T>
struct SignalTables {
    SignalTablePlan plan;
    std::vector<T> texels;  ///< 4 plan.texel_count()

    std::size_t byte_count() const { return texels.size() * sizeof(T); }
};

/// Tables whose bound is within the budget. Coarser levels of low bands save cache, not memory: the array
/// holds every layer at every level.
/// order   : one whose lobe kernels are compiled in.
/// signal  : order^2 coefficients, index l(l+1)+m; norms and errors are taken over all channels together.
/// Errors  : zonal::Error when the order has no lobes here, the signal is of another length, zero, not
///           finite or, for half, possibly beyond 65504; when an option is out of range; when no tables of
///           this format and at most `largest_face` texels reach the budget.
/// Half of the squared budget chooses level 0, the other half coarser levels of low bands; what is left then
/// makes all of them smaller.
template <class T>
ZONAL_API SignalTablePlan plan_signal_tables(int order, std::span<const Rgb<float>> signal,
                                             const SignalTableOptions& options);

/// The plan and its texels. Cost: about order^2 multiplications a texel.
template <class T>
ZONAL_API SignalTables<T> build_signal_tables(int order, std::span<const Rgb<float>> signal,
                                              const SignalTableOptions& options);

/// The unit direction of a texel of a face with `size` texels along an edge: Vulkan's and OpenGL's faces and
/// their (s, t), columns along s, rows along t, stretched.
ZONAL_API Eigen::Vector3d face_texel_direction(int size, int face, int row, int column);

}  // namespace zonal
