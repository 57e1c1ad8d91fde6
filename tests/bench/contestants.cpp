#include "contestants.hpp"

#include <benchmark/benchmark.h>

#include <memory>

#include "bench/baselines/dense_product.hpp"
#include "bench/baselines/euler_zyz.hpp"
#include "bench/baselines/ivanic_ruedenberg.hpp"
#include "bench/baselines/zxzxz.hpp"
#include "bench/baselines/zyz_without_angles.hpp"
#include "zonal/orders.hpp"

namespace zonal::bench {
namespace {

/// Single calls in a loop; Kernel::rotate<T>(R, f, out) is inlined as a user's would be. Clobbered memory
/// keeps clang++ from making packs of them.
template <class Kernel, int N, class T>
SingleCall<T> single_call(const char* name) {
    return {name,
            [](const Arrays<T>& a) {
                for (std::size_t k = 0; k < a.count; ++k) {
                    Kernel::rotate(a.rotations + 9 * k, a.in + N * N * k, a.out + N * N * k);
                    benchmark::ClobberMemory();
                }
            },
            [](const T* R, const T* f, T* out) { Kernel::rotate(R, f, out); }};
}

/// The same of what others do; its tables are made once.
template <class T, class Baseline>
SingleCall<T> baseline(const char* name, int order) {
    const auto kernel = std::make_shared<Baseline>(order);
    const std::size_t size = static_cast<std::size_t>(order) * order;
    return {name,
            [=](const Arrays<T>& a) {
                for (std::size_t k = 0; k < a.count; ++k)
                    kernel->rotate(a.rotations + 9 * k, a.in + size * k, a.out + size * k);
            },
            [=](const T* R, const T* f, T* out) { kernel->rotate(R, f, out); }};
}

template <int N, baselines::SineOfBeta form>
struct Zyz {
    template <class T>
    static void rotate(const T* R, const T* f, T* out) {
        baselines::zyz_without_angles<N, form>(R, f, out);
    }
};

// Kernels of an order that take part, for whatever ZONAL_BENCH_KERNEL is at the time.
#define ZONAL_BENCH_EXACT(N) ZONAL_BENCH_KERNEL(N, rotate) ZONAL_BENCH_KERNEL(N, rotate_accurate)
#define ZONAL_BENCH_TENSOR(N) ZONAL_BENCH_KERNEL(N, rotate_fewest) ZONAL_BENCH_KERNEL(N, rotate_tensor)
#define ZONAL_BENCH_LOBES(N) ZONAL_BENCH_KERNEL(N, rotate_zhf)

#define ZONAL_BENCH_KERNEL(N, kernel)                        \
    struct kernel##_of_##N {                                 \
        template <class T>                                   \
        static void rotate(const T* R, const T* f, T* out) { \
            order##N::kernel<T, T>(R, f, out);               \
        }                                                    \
    };
ZONAL_FOR_EACH_ORDER(ZONAL_BENCH_EXACT)
ZONAL_FOR_EACH_TENSOR_ORDER(ZONAL_BENCH_TENSOR)
ZONAL_FOR_EACH_ZHF_ORDER(ZONAL_BENCH_LOBES)
#undef ZONAL_BENCH_KERNEL

}  // namespace

template <class T>
std::vector<SingleCall<T>> single_calls(int order) {
    std::vector<SingleCall<T>> calls;
#define ZONAL_BENCH_KERNEL(N, kernel) \
    if (order == N) calls.push_back(single_call<kernel##_of_##N, N, T>(#kernel));
    ZONAL_FOR_EACH_ORDER(ZONAL_BENCH_EXACT)
    ZONAL_FOR_EACH_TENSOR_ORDER(ZONAL_BENCH_TENSOR)
    ZONAL_FOR_EACH_ZHF_ORDER(ZONAL_BENCH_LOBES)
#undef ZONAL_BENCH_LOBES
#undef ZONAL_BENCH_TENSOR
#undef ZONAL_BENCH_EXACT
#undef ZONAL_BENCH_KERNEL
    using enum baselines::SineOfBeta;
#define ZONAL_BENCH_ZYZ(N)                                                                                \
    if constexpr (N <= baselines::kLastZyzOrder) {                                                        \
        if (order == N) calls.push_back(single_call<Zyz<N, root_of_cosine>, N, T>(kZyz));                 \
        if (order == N) calls.push_back(single_call<Zyz<N, length_of_column>, N, T>("z-y-z, two roots")); \
    }
    ZONAL_FOR_EACH_ORDER(ZONAL_BENCH_ZYZ)
#undef ZONAL_BENCH_ZYZ
    calls.push_back(baseline<T, baselines::Zxzxz<T>>(kZxzxz, order));
    calls.push_back(baseline<T, baselines::EulerZyz<T>>("z-y-z with angles", order));
    calls.push_back(baseline<T, baselines::IvanicRuedenberg<T>>("Ivanic-Ruedenberg", order));
    return calls;
}

template <class T>
SingleCall<T> dense_product(int order) {
    const auto recursion = std::make_shared<baselines::IvanicRuedenberg<T>>(order);
    const auto turn = [=](const Arrays<T>& a) {
        const std::size_t size = static_cast<std::size_t>(order) * order;
        std::vector<T> blocks(baselines::block_offset(order));
        recursion->blocks(a.rotations, blocks.data());
        for (std::size_t k = 0; k < a.count; ++k)
            baselines::apply_blocks(order, blocks.data(), a.in + size * k, a.out + size * k);
    };
    return {"dense, Eigen", turn, [=](const T* R, const T* f, T* out) { turn({R, f, out, 1}); }};
}

template SingleCall<float> dense_product<float>(int);
template SingleCall<double> dense_product<double>(int);
template std::vector<SingleCall<float>> single_calls<float>(int);
template std::vector<SingleCall<double>> single_calls<double>(int);

}  // namespace zonal::bench
