#pragma once

#include "zonal/orders.hpp"

namespace zonal {

/// The generated kernels of order N as static members, so that a test can be written once for every order.
template <int N>
struct Order;
/// The lobe kernels, for the orders that have them.
template <int N>
struct LobeOrder;

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

#define ZONAL_TEST_LOBE_ORDER(N)                                 \
    template <>                                                  \
    struct LobeOrder<N> {                                        \
        template <class T, class V>                              \
        static void rotate_zhf(const T* R, const V* f, V* out) { \
            order##N::rotate_zhf(R, f, out);                     \
        }                                                        \
        template <class T>                                       \
        static void lobes(const T* R, T* directions) {           \
            order##N::lobes(R, directions);                      \
        }                                                        \
        template <class V>                                       \
        static void factorize(const V* f, V* z) {                \
            order##N::factorize(f, z);                           \
        }                                                        \
        template <class V>                                       \
        static void expand(const V* z, V* f) {                   \
            order##N::expand(z, f);                              \
        }                                                        \
        template <class V>                                       \
        static void resample(const V* samples, V* out) {         \
            order##N::resample(samples, out);                    \
        }                                                        \
    };
ZONAL_FOR_EACH_LOBE_ORDER(ZONAL_TEST_LOBE_ORDER)
#undef ZONAL_TEST_LOBE_ORDER

}  // namespace zonal
