#pragma once

// The generated kernels of order N as static members of PackKernels<N>.

#include "zonal/orders.hpp"

namespace zonal {

template <int N>
struct PackKernels;

#define ZONAL_PACK_KERNELS(N)                                               \
    template <>                                                             \
    struct PackKernels<N> {                                                 \
        static constexpr bool kTakesMirrors = order##N::kTakesMirrors != 0; \
        static constexpr int kScalars = order##N::kScalars;                 \
        template <class P>                                                  \
        static void rotate(const P* rotation, P* f) {                       \
            order##N::rotate<P, P>(rotation, f, f);                         \
        }                                                                   \
        template <class P>                                                  \
        static void prepare(const P* rotation, P* scalars) {                \
            order##N::prepare<P>(rotation, scalars);                        \
        }                                                                   \
        template <class P>                                                  \
        static void apply(const P* scalars, P* f) {                         \
            order##N::apply<P, P>(scalars, f, f);                           \
        }                                                                   \
        template <class P>                                                  \
        static void blocks(const P* rotation, P* dense) {                   \
            order##N::blocks<P>(rotation, dense);                           \
        }                                                                   \
    };
ZONAL_FOR_EACH_ORDER(ZONAL_PACK_KERNELS)
#undef ZONAL_PACK_KERNELS

/// The kernel for one vector a lane: `rotate_tensor` where there is one. On packs its further products
/// cost less than waiting for the divisions and roots of `rotate`.
template <int N>
struct AtOnce {
    static constexpr bool kTakesMirrors = PackKernels<N>::kTakesMirrors;
    template <class P>
    static void rotate(const P* rotation, P* f) {
        PackKernels<N>::rotate(rotation, f);
    }
};

#define ZONAL_TENSOR_KERNEL(N)                             \
    template <>                                            \
    struct AtOnce<N> {                                     \
        static constexpr bool kTakesMirrors = true;        \
        template <class P>                                 \
        static void rotate(const P* rotation, P* f) {      \
            order##N::rotate_tensor<P, P>(rotation, f, f); \
        }                                                  \
    };
ZONAL_FOR_EACH_TENSOR_ORDER(ZONAL_TENSOR_KERNEL)
#undef ZONAL_TENSOR_KERNEL

/// Interleaved channels of float, all vectors by one rotation: products with dense blocks, which need no
/// transposition, are faster than `prepare` and `apply` in these orders.
constexpr bool turns_channels_densely(int order) { return 3 <= order && order <= 6; }

}  // namespace zonal
