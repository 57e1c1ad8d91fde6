// Chooses at run time among the kernels compiled in, and checks each call once at this door.

#include "zonal/rotate.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <functional>

#include "checks.hpp"
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
                 .found = fmt::format("{}", order),
                 .wanted = fmt::format("an order that is compiled in: {}", fmt::join(kCompiledOrders, ", ")),
                 .next_step = "add the order to cmake/orders.cmake, generate its kernels and build again"});
}

template <class V>
void check_overlap(std::span<const V> in, std::span<V> out) {
    const std::less<const V*> before;
    const bool overlaps =
        before(in.data(), out.data() + out.size()) && before(out.data(), in.data() + in.size());
    if (!overlaps || in.data() == out.data()) return;
    throw Error({.field = "in and out",
                 .found = "spans that overlap in part",
                 .wanted = "the same span, or separate ones",
                 .next_step = "rotate into a separate array"});
}

template <class T, class V>
void checked_rotate(int order, const RotationMatrix<T>& rotation, std::span<const V> in, std::span<V> out) {
    check_compiled(order);
    check_length("in", order, in.size());
    check_length("out", order, out.size());
    check_overlap(in, out);
    switch (order) {
#define ZONAL_CASE(N) \
    case N:           \
        return order##N::rotate<T, V>(rotation.data(), in.data(), out.data());
        ZONAL_FOR_EACH_ORDER(ZONAL_CASE)
#undef ZONAL_CASE
    }
}

}  // namespace

std::span<const int> compiled_orders() { return kCompiledOrders; }

void rotate(int order, const RotationMatrix<float>& rotation, std::span<const float> in,
            std::span<float> out) {
    checked_rotate(order, rotation, in, out);
}

void rotate(int order, const RotationMatrix<double>& rotation, std::span<const double> in,
            std::span<double> out) {
    checked_rotate(order, rotation, in, out);
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
