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

/// The kernels of shared lobes, for the orders that have all of them.
template <int N>
struct LobeOrder;

#define ZONAL_TEST_LOBE_ORDER(N)          \
    template <>                           \
    struct LobeOrder<N> {                 \
        ZONAL_TEST_LOBE_KERNELS(order##N) \
        ZONAL_TEST_ROTATE_ZHF(order##N)   \
    };
ZONAL_FOR_EACH_ZHF_ORDER(ZONAL_TEST_LOBE_ORDER)
#undef ZONAL_TEST_LOBE_ORDER
#undef ZONAL_TEST_LOBE_KERNELS
#undef ZONAL_TEST_ROTATE_ZHF

}  // namespace zonal
