#pragma once

#include "zonal/orders.hpp"

namespace zonal {

/// The generated kernels of order N as static members, so that a test can be written once for every order.
template <int N>
struct Order;

#define ZONAL_TEST_ORDER(N)                                      \
    template <>                                                  \
    struct Order<N> {                                            \
        template <class T, class V>                              \
        static void rotate(const T* R, const V* f, V* out) {     \
            order##N::rotate(R, f, out);                         \
        }                                                        \
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
ZONAL_FOR_EACH_ORDER(ZONAL_TEST_ORDER)
#undef ZONAL_TEST_ORDER

}  // namespace zonal
