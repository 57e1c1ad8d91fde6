#pragma once

// The generated kernels, compiled once for every test that runs them (compiled_order.cpp), behind pointers: a
// test is then code of no order and no type. A pointer is null where an order has no such kernel, or no test
// asks for it in that type.

#include <string>
#include <type_traits>
#include <vector>

#include "support/channels.hpp"
#include "support/counting.hpp"
#include "zonal/rgb.hpp"

namespace zonal {

template <class T, class V = T>
using RotateKernel = void (*)(const T* R, const V* f, V* out);
/// Of a rotation, or of a signal, alone.
template <class T>
using OneInputKernel = void (*)(const T* in, T* out);

template <class T, class V = T>
struct RotateKernels {
    RotateKernel<T, V> rotate = nullptr, rotate_accurate = nullptr, rotate_fewest = nullptr,
                       rotate_tensor = nullptr;
    OneInputKernel<T> prepare = nullptr, blocks = nullptr;
    RotateKernel<T, V> apply = nullptr;  ///< of what `prepare` made
};

template <class T>
struct LobeKernels {
    OneInputKernel<T> lobes = nullptr, factorize = nullptr, expand = nullptr, resample = nullptr;
    RotateKernel<T> rotate_zhf = nullptr;
};

/// Kernels of one set of lobes, and where the lobes and their weights stand: band l has `count(l)` lobes, the
/// d-th of them with weight `weight(l, d)` and direction `direction(l, d)`.
struct LobeVariant {
    enum class Layout { shared, ring, per_band };

    std::string prefix;  ///< of names: "", "stable::", "per_band::"
    Layout layout;
    int order;
    LobeKernels<float> in_float;
    LobeKernels<double> in_double;
    LobeKernels<Counting> counting;
    RotateKernel<float, Channels> rotate_zhf_channels = nullptr;
    OneInputKernel<Rgb<double>> factorize_rgb = nullptr;

    int ring() const { return 2 * order - 1; }
    int directions() const { return layout == Layout::per_band ? order * order : ring(); }
    int weights() const { return layout == Layout::ring ? order * ring() : order * order; }
    int count(int l) const { return layout == Layout::ring ? ring() : 2 * l + 1; }
    int weight(int l, int d) const { return (layout == Layout::ring ? l * ring() : l * l) + d; }
    int direction(int l, int d) const { return (layout == Layout::per_band ? l * l : 0) + d; }

    template <class T>
    const LobeKernels<T>& in() const {
        if constexpr (std::is_same_v<T, float>) return in_float;
        if constexpr (std::is_same_v<T, double>) return in_double;
    }
};

struct CompiledOrder {
    int order;
    int scalars;  ///< values that `prepare` makes
    bool takes_mirrors;
    RotateKernels<float> in_float;
    RotateKernels<double> in_double;
    RotateKernels<float, Channels> in_channels;
    RotateKernels<Counting> counting;
    RotateKernel<double, Rgb<double>> rotate_rgb = nullptr;
    RotateKernel<Counting, CountingRgb> rotate_counting_rgb = nullptr;
    RotateKernel<double, CountingSignal> rotate_counting_signal = nullptr,
                                         rotate_tensor_counting_signal = nullptr;
    std::vector<LobeVariant> lobes;

    int size() const { return order * order; }
    int blocks_size() const { return order * (4 * order * order - 1) / 3; }
    bool has_tensor() const { return in_double.rotate_tensor != nullptr; }
    template <class T>
    const RotateKernels<T>& in() const {
        if constexpr (std::is_same_v<T, float>) return in_float;
        if constexpr (std::is_same_v<T, double>) return in_double;
    }
};

/// Ascending.
const std::vector<CompiledOrder>& compiled_orders();
/// Throws std::out_of_range for an order that is not compiled.
const CompiledOrder& compiled_order(int order);
/// Whether an order is to have lobes, or `rotate_tensor`, whatever its header says.
constexpr bool is_to_have_lobes(int order) { return order >= 3; }
constexpr bool is_to_have_tensor(int order) { return order <= 4; }
/// The orders, and the sets of lobes of these layouts, that are compiled and to have such kernels. Throw
/// std::logic_error where one is gone: a test that runs over them fails then.
std::vector<CompiledOrder> orders_with_tensor();
std::vector<LobeVariant> lobes_of_all_orders(const std::vector<LobeVariant::Layout>& layouts);
/// For the files that hold one order each.
bool add_compiled_order(CompiledOrder order);

}  // namespace zonal
