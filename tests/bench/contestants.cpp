#include "contestants.hpp"

#include <memory>

#include "bench/baselines/euler_zyz.hpp"
#include "bench/baselines/ivanic_ruedenberg.hpp"
#include "bench/baselines/zxzxz.hpp"
#include "zonal/orders.hpp"

namespace zonal::bench {
namespace {

/// A single call in a loop; Kernel::rotate<T>(R, f, out) is inlined as a user's would be.
template <class Kernel, int N, class T>
SingleCall<T> single_call(const char* name) {
    return {name,
            [](const Arrays<T>& a) {
                for (std::size_t k = 0; k < a.count; ++k)
                    Kernel::rotate(a.rotations + 9 * k, a.in + N * N * k, a.out + N * N * k);
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

#define ZONAL_BENCH_KERNEL(N)                                \
    struct Order##N {                                        \
        template <class T>                                   \
        static void rotate(const T* R, const T* f, T* out) { \
            order##N::rotate<T, T>(R, f, out);               \
        }                                                    \
    };
ZONAL_FOR_EACH_ORDER(ZONAL_BENCH_KERNEL)
#undef ZONAL_BENCH_KERNEL

}  // namespace

template <class T>
std::vector<SingleCall<T>> single_calls(int order) {
    std::vector<SingleCall<T>> calls;
#define ZONAL_BENCH_KERNEL(N) \
    if (order == N) calls.push_back(single_call<Order##N, N, T>("rotate"));
    ZONAL_FOR_EACH_ORDER(ZONAL_BENCH_KERNEL)
#undef ZONAL_BENCH_KERNEL
    calls.push_back(baseline<T, baselines::Zxzxz<T>>("zxzxz with angles", order));
    calls.push_back(baseline<T, baselines::EulerZyz<T>>("z-y-z with angles", order));
    calls.push_back(baseline<T, baselines::IvanicRuedenberg<T>>("Ivanic-Ruedenberg", order));
    return calls;
}

template std::vector<SingleCall<float>> single_calls<float>(int);
template std::vector<SingleCall<double>> single_calls<double>(int);

}  // namespace zonal::bench
