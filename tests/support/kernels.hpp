#pragma once

#include "zonal/orders.hpp"

namespace zonal {

/// The generated kernels of order N as static members, so that a test can be written once for every order.
template <int N>
struct Order;

#define ZONAL_TEST_ORDER(N)                                                 \
    template <>                                                             \
    struct Order<N> {                                                       \
        static constexpr int kScalars = order##N::kScalars;                 \
        static constexpr bool kTakesMirrors = order##N::kTakesMirrors != 0; \
        template <class T, class V>                                         \
        static void rotate(const T* R, const V* f, V* out) {                \
            order##N::rotate(R, f, out);                                    \
        }                                                                   \
        template <class T, class V>                                         \
        static void rotate_accurate(const T* R, const V* f, V* out) {       \
            order##N::rotate_accurate(R, f, out);                           \
        }                                                                   \
        template <class T>                                                  \
        static void blocks(const T* R, T* dense) {                          \
            order##N::blocks(R, dense);                                     \
        }                                                                   \
        template <class T>                                                  \
        static void prepare(const T* R, T* scalars) {                       \
            order##N::prepare(R, scalars);                                  \
        }                                                                   \
        template <class T, class V>                                         \
        static void apply(const T* scalars, const V* f, V* out) {           \
            order##N::apply(scalars, f, out);                               \
        }                                                                   \
    };
ZONAL_FOR_EACH_ORDER(ZONAL_TEST_ORDER)
#undef ZONAL_TEST_ORDER

/// The kernel of products and sums alone, for the orders that have it.
template <int N>
struct TensorOrder;

#define ZONAL_TEST_TENSOR_ORDER(N)                           \
    template <>                                              \
    struct TensorOrder<N> {                                  \
        template <class T, class V>                          \
        static void rotate(const T* R, const V* f, V* out) { \
            order##N::rotate_tensor(R, f, out);              \
        }                                                    \
    };
ZONAL_FOR_EACH_TENSOR_ORDER(ZONAL_TEST_TENSOR_ORDER)
#undef ZONAL_TEST_TENSOR_ORDER

/// Where the lobes of a variant and their weights stand: band l has `count(l)` lobes, the d-th of them with
/// weight `weight(l, d)` and direction `direction(l, d)`.
template <int N>
struct SharedLayout {
    static constexpr int kOrder = N, kDirections = 2 * N - 1, kWeights = N * N;
    static constexpr const char* kPrefix = "";
    static int count(int l) { return 2 * l + 1; }
    static int weight(int l, int d) { return l * l + d; }
    static int direction(int, int d) { return d; }
};
template <int N>
struct RingLayout {
    static constexpr int kOrder = N, kDirections = 2 * N - 1, kWeights = N * (2 * N - 1);
    static constexpr const char* kPrefix = "stable::";
    static int count(int) { return 2 * N - 1; }
    static int weight(int l, int d) { return l * (2 * N - 1) + d; }
    static int direction(int, int d) { return d; }
};
template <int N>
struct PerBandLayout {
    static constexpr int kOrder = N, kDirections = N * N, kWeights = N * N;
    static constexpr const char* kPrefix = "per_band::";
    static int count(int l) { return 2 * l + 1; }
    static int weight(int l, int d) { return l * l + d; }
    static int direction(int l, int d) { return l * l + d; }
};

#define ZONAL_TEST_LOBE_KERNELS(place)               \
    template <class T>                               \
    static void lobes(const T* R, T* directions) {   \
        place::lobes(R, directions);                 \
    }                                                \
    template <class V>                               \
    static void factorize(const V* f, V* z) {        \
        place::factorize(f, z);                      \
    }                                                \
    template <class V>                               \
    static void expand(const V* z, V* f) {           \
        place::expand(z, f);                         \
    }                                                \
    template <class V>                               \
    static void resample(const V* samples, V* out) { \
        place::resample(samples, out);               \
    }
#define ZONAL_TEST_ROTATE_ZHF(place)                         \
    template <class T, class V>                              \
    static void rotate_zhf(const T* R, const V* f, V* out) { \
        place::rotate_zhf(R, f, out);                        \
    }

/// The lobe kernels of the variants, for the orders that have them.
template <int N>
struct LobeOrder;
template <int N>
struct StableOrder;
template <int N>
struct PerBandOrder;

#define ZONAL_TEST_LOBE_ORDER(N)                  \
    template <>                                   \
    struct LobeOrder<N> : SharedLayout<N> {       \
        ZONAL_TEST_LOBE_KERNELS(order##N)         \
        ZONAL_TEST_ROTATE_ZHF(order##N)           \
    };                                            \
    template <>                                   \
    struct StableOrder<N> : RingLayout<N> {       \
        ZONAL_TEST_LOBE_KERNELS(order##N::stable) \
        ZONAL_TEST_ROTATE_ZHF(order##N::stable)   \
    };
ZONAL_FOR_EACH_LOBE_ORDER(ZONAL_TEST_LOBE_ORDER)
#undef ZONAL_TEST_LOBE_ORDER

#define ZONAL_TEST_PER_BAND_ORDER(N)                \
    template <>                                     \
    struct PerBandOrder<N> : PerBandLayout<N> {     \
        ZONAL_TEST_LOBE_KERNELS(order##N::per_band) \
    };
ZONAL_FOR_EACH_PER_BAND_ORDER(ZONAL_TEST_PER_BAND_ORDER)
#undef ZONAL_TEST_PER_BAND_ORDER
#undef ZONAL_TEST_LOBE_KERNELS
#undef ZONAL_TEST_ROTATE_ZHF

}  // namespace zonal
