#pragma once

// The generated kernels of order N as static members of OrderKernels<N>.
//
// SHIM: headers without the split into `prepare` and `apply` are served by `rotate`. Once every committed
// header has the split, `kScalars` below and the branches on `kIsSplit` go.

#include "zonal/orders.hpp"

namespace zonal {

inline constexpr int kScalars = 0;  // found by name only where orderN has no kScalars of its own

template <int N>
struct OrderKernels;

}  // namespace zonal

#define ZONAL_ORDER_KERNELS(N)                                            \
    namespace zonal::order##N {                                           \
        struct Kernels {                                                  \
            static constexpr bool kIsSplit = kScalars > 0;                \
            static constexpr int kCount = kIsSplit ? kScalars : 9;        \
            template <class P>                                            \
            static void rotate_pack(const P* rotation, P* f) {            \
                rotate<P, P>(rotation, f, f);                             \
            }                                                             \
            template <class P>                                            \
            static void prepare_pack(const P* rotation, P* scalars) {     \
                if constexpr (kIsSplit)                                   \
                    prepare<P>(rotation, scalars);                        \
                else                                                      \
                    for (int i = 0; i < 9; ++i) scalars[i] = rotation[i]; \
            }                                                             \
            template <class P>                                            \
            static void apply_pack(const P* scalars, P* f) {              \
                if constexpr (kIsSplit)                                   \
                    apply<P, P>(scalars, f, f);                           \
                else                                                      \
                    rotate<P, P>(scalars, f, f);                          \
            }                                                             \
        };                                                                \
    }                                                                     \
    namespace zonal {                                                     \
    template <>                                                           \
    struct OrderKernels<N> : order##N::Kernels {};                        \
    }
ZONAL_FOR_EACH_ORDER(ZONAL_ORDER_KERNELS)
#undef ZONAL_ORDER_KERNELS
