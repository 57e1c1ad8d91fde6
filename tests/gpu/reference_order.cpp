// The generated kernels of one order, ZONAL_GPU_ORDER in ZONAL_GPU_HEADER, compiled with ZONAL_NO_FMA and
// -ffp-contract=off.
#include <cmath>
#include <type_traits>

#include "gpu/reference.hpp"

#ifndef ZONAL_NO_FMA
#error "these kernels are compared bit by bit: compile with ZONAL_NO_FMA"
#endif

// A name of its own: the linker merges instances of one template, and others are compiled with fused
// instructions.
#define zonal zonal_unfused
#include ZONAL_GPU_HEADER
#undef zonal

namespace zonal::gpu {

inline Channels operator+(Channels a, Channels b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
inline Channels operator-(Channels a, Channels b) { return {a.r - b.r, a.g - b.g, a.b - b.b}; }
inline Channels operator-(Channels a) { return {-a.r, -a.g, -a.b}; }
inline Channels operator*(float a, Channels b) { return {a * b.r, a * b.g, a * b.b}; }
inline Channels fma(float a, Channels b, Channels c) { return a * b + c; }

namespace {

#define ZONAL_JOIN_(a, b) a##b
#define ZONAL_JOIN(a, b) ZONAL_JOIN_(a, b)
namespace order = ::zonal_unfused::ZONAL_JOIN(order, ZONAL_GPU_ORDER);

constexpr int N = ZONAL_GPU_ORDER, kSize = N * N;

// A kernel of a rotation and a signal, of a rotation, of a signal.
#define ZONAL_TURN(place, kernel, scalars)                                                  \
    {                                                                                       \
        .rotation_size = scalars, .input_size = kSize, .output_size = kSize,                \
        .run = [](const float* R, const float* f, float* out) { place::kernel(R, f, out); } \
    }
#define ZONAL_OF_ROTATION(place, kernel, size)                                         \
    {                                                                                  \
        .rotation_size = 9, .output_size = size,                                       \
        .run = [](const float* R, const float*, float* out) { place::kernel(R, out); } \
    }
#define ZONAL_OF_SIGNAL(place, kernel, from, to)                                         \
    {                                                                                    \
        .input_size = from, .output_size = to,                                           \
        .run = [](const float*, const float* in, float* out) { place::kernel(in, out); } \
    }

ReferenceKernel named(const std::string& name, ReferenceKernel kernel) {
    kernel.name = name;
    return kernel;
}

std::vector<ReferenceKernel> kernels() {
    std::vector<ReferenceKernel> all{
        // What `rotate` is in shaders, by their banners.
        named("rotate", ZONAL_TURN(order, rotate_fewest, 9)),
        named("rotate_fewest", ZONAL_TURN(order, rotate_fewest, 9)),
        named("prepare", ZONAL_OF_ROTATION(order, prepare, order::kScalars)),
        named("apply", ZONAL_TURN(order, apply, order::kScalars)),
        named("rotate_accurate", ZONAL_TURN(order, rotate_accurate, 9)),
        named("blocks", ZONAL_OF_ROTATION(order, blocks, N * (4 * N * N - 1) / 3)),
    };
    all.front().run_channels = [](const float* R, const Channels* f, Channels* out) {
        order::rotate_fewest(R, f, out);
    };
    all[1].run_channels = all.front().run_channels;
#if ZONAL_GPU_ORDER <= 4
    all.push_back(named("rotate_tensor", ZONAL_TURN(order, rotate_tensor, 9)));
#endif
#if ZONAL_GPU_ORDER > 2
    constexpr int kRing = 2 * N - 1;
#define ZONAL_LOBES(prefix, place, weights, directions)                                          \
    all.push_back(named(prefix "factorize", ZONAL_OF_SIGNAL(place, factorize, kSize, weights))); \
    all.push_back(named(prefix "expand", ZONAL_OF_SIGNAL(place, expand, weights, kSize)));       \
    all.push_back(named(prefix "resample", ZONAL_OF_SIGNAL(place, resample, weights, kSize)));   \
    all.push_back(named(prefix "lobes", ZONAL_OF_ROTATION(place, lobes, 3 * directions)))
    ZONAL_LOBES("", order, kSize, kRing);
    ZONAL_LOBES("per_band_", order::per_band, kSize, kSize);
    ZONAL_LOBES("stable_", order::stable, N * kRing, kRing);
    all.push_back(named("rotate_zhf", ZONAL_TURN(order, rotate_zhf, 9)));
    all.push_back(named("stable_rotate_zhf", ZONAL_TURN(order::stable, rotate_zhf, 9)));
#endif
    return all;
}

static_assert(order::kHasTensor == (N <= 4));
static_assert(order::kHasLobes == (N > 2) && order::kHasPerBandLobes == (N > 2));

[[maybe_unused]] const bool kIsAdded = add_reference_kernels(N, kernels());

}  // namespace
}  // namespace zonal::gpu
