// Chooses at run time among the kernels compiled in, and checks each call once at this door.

#include "zonal/rotate.hpp"

#include <algorithm>
#include <array>

#include "checks.hpp"
#include "colours.hpp"
#include "text.hpp"
#include "unchecked.hpp"
#include "zonal/error.hpp"
#include "zonal/orders.hpp"

namespace zonal {
namespace {

#define ZONAL_LIST_ENTRY(N) N,
constexpr auto kCompiledOrders = std::to_array<int>({ZONAL_FOR_EACH_ORDER(ZONAL_LIST_ENTRY)});
#undef ZONAL_LIST_ENTRY

void check_compiled(int order) {
    if (std::ranges::find(kCompiledOrders, order) != kCompiledOrders.end()) return;
    throw Error({.field = "order",
                 .found = text_of(order),
                 .wanted = joined("an order that is compiled in: ", list_of(kCompiledOrders)),
                 .next_step = "add the order to cmake/orders.cmake, generate its kernels and build again"});
}

template <class T, class V>
void dispatch(int order, const T* rotation, const V* in, V* out) {
    switch (order) {
#define ZONAL_CASE(N) \
    case N:           \
        return order##N::rotate<T, V>(rotation, in, out);
        ZONAL_FOR_EACH_ORDER(ZONAL_CASE)
#undef ZONAL_CASE
    }
}

template <class T, class V>
void checked_rotate(int order, const RotationMatrix<T>& rotation, std::span<const V> in, std::span<V> out) {
    check_compiled(order);
    check_rotated_length("in", order, in.size());
    check_rotated_length("out", order, out.size());
    check_no_partial_overlap(in, out);
    rotate_unchecked(order, rotation, in.data(), out.data());
}

template <class T>
void checked_rotate_values(int order, const RotationMatrix<T>& rotation, std::span<const T> in,
                           std::span<T> out) {
    call_with_channels(order, in, out,
                       [&](auto from, auto to) { checked_rotate(order, rotation, from, to); });
}

}  // namespace

template <class T, class V>
void rotate_unchecked(int order, const RotationMatrix<T>& rotation, const V* in, V* out) {
    // Kernels need determinant +1: a mirror is a rotation by -R, then a change of sign in the odd bands.
    if (!is_mirror(rotation)) return dispatch(order, rotation.data(), in, out);
    T turned[9];
    for (int i = 0; i < 9; ++i) turned[i] = -rotation.data()[i];
    dispatch(order, turned, in, out);
    for (int l = 1; l < order; l += 2)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i) out[i] = -out[i];
}
template ZONAL_API void rotate_unchecked(int, const RotationMatrix<float>&, const float*, float*);
template ZONAL_API void rotate_unchecked(int, const RotationMatrix<double>&, const double*, double*);
template ZONAL_API void rotate_unchecked(int, const RotationMatrix<float>&, const Rgb<float>*, Rgb<float>*);
template ZONAL_API void rotate_unchecked(int, const RotationMatrix<double>&, const Rgb<double>*,
                                         Rgb<double>*);

std::span<const int> compiled_orders() { return kCompiledOrders; }

void rotate(int order, const RotationMatrix<float>& rotation, std::span<const float> in,
            std::span<float> out) {
    checked_rotate_values(order, rotation, in, out);
}

void rotate(int order, const RotationMatrix<double>& rotation, std::span<const double> in,
            std::span<double> out) {
    checked_rotate_values(order, rotation, in, out);
}

void rotate(int order, const RotationMatrix<float>& rotation, std::span<const Rgb<float>> in,
            std::span<Rgb<float>> out) {
    checked_rotate(order, rotation, in, out);
}

void rotate(int order, const RotationMatrix<double>& rotation, std::span<const Rgb<double>> in,
            std::span<Rgb<double>> out) {
    checked_rotate(order, rotation, in, out);
}

}  // namespace zonal
