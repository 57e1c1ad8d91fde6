// Every compiled kernel that turns a signal against the pointwise oracle, float and double: the numbers the
// project promises. Orders above those compiled: graph_accuracy_test.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

#include "support/accuracy.hpp"
#include "support/banner.hpp"
#include "support/compiled_kernels.hpp"
#include "support/flushed_denormals.hpp"
#include "support/many_turns.hpp"

namespace zonal {
namespace {

constexpr std::uint64_t kSeed = 20240611;

/// The kernel that publishes what a contestant is judged by: the first word of its name.
std::string kernel_of(const std::string& name) { return name.substr(0, name.find(' ')); }

/// Within the published bound, what R excuses being what the banner says; for rotations within the contract
/// too.
template <class T>
void expect_within_bounds(int order, const std::vector<accuracy::Contestant<T>>& kernels) {
    constexpr bool kIsFloat = std::is_same_v<T, float>;
    const int random_count = order <= 6 ? 10000 : 1000, thinning = order <= 6 ? 1 : 10;
    const auto problems = accuracy::problems<T>(order, random_count, thinning, kSeed + order);
    const auto worst = accuracy::worst_errors<T>(oracle::Rotation(order), problems, kernels);
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        const std::string &name = kernels[k].name, kernel = kernel_of(name);
        const banner::Bound bound = banner::bound(order, kernel);
        EXPECT_LE(worst[k].error, kIsFloat ? bound.float_bound : bound.double_bound)
            << name << ", order " << order << ", " << worst[k].name;
        // Order 2 in float, a product with R of three roundings a row, exceeds b_N by 2 % in one case of
        // 60 000: it is held to what the contract grants rare cases, twice b_N.
        const double contract =
            accuracy::contract(kernel, order, kIsFloat) * (order == 2 && kIsFloat ? 2 : 1);
        EXPECT_LE(worst[k].error_of_rotations, contract)
            << name << ", order " << order << ", " << worst[k].name_of_rotations;
        // Noise in R costs band 2 read by the trace up to 2.12 ‖R Rᵀ - I‖_F (tests/bench/README.md), and the
        // contract grants 1 at order 3. Single bands show it.
        const bool is_by_trace = kernel == "rotate" || kernel == "rotate_fewest" || kernel == "rotate_tensor";
        if (order == 3 && kIsFloat && is_by_trace) continue;
        EXPECT_LE(worst[k].error_of_bands, contract)
            << name << ", order " << order << ", " << worst[k].name_of_bands;
    }
}

/// Mirrors are its own where its words say so: it is given them as they are.
template <class T, class Rotate>
accuracy::Contestant<T> by_its_words(int order, const std::string& name, Rotate rotate) {
    const banner::Bound words = banner::bound(order, kernel_of(name));
    const accuracy::Contestant<T> kernel{name, rotate, words.excess};
    return words.takes_mirrors ? kernel : accuracy::with_mirrors(order, kernel);
}

template <class T>
T& channel(Rgb<T>& value, int number) {
    return number == 0 ? value.r : number == 1 ? value.g : value.b;
}
float& channel(Channels& value, int number) { return value.c[number]; }

/// A kernel of three channels as one of a signal, which is in each channel in turn, other values in the
/// others.
template <class T, class V, class Rotate>
auto in_one_of_three_channels(int order, Rotate rotate) {
    const auto size = static_cast<std::size_t>(order * order);
    return [rotate, in = std::vector<V>(size), turned = std::vector<V>(size), number = 0](
               const T* R, const T* f, T* out) mutable {
        number = (number + 1) % 3;
        for (std::size_t i = 0; i < in.size(); ++i)
            for (const int at : {0, 1, 2}) channel(in[i], at) = at == number ? f[i] : T(1 + at);
        rotate(R, in.data(), turned.data());
        for (std::size_t i = 0; i < in.size(); ++i) out[i] = channel(turned[i], number);
    };
}

/// `prepare` and `apply`.
template <class T, class V>
auto halves(const CompiledOrder& compiled, const RotateKernels<T, V>& kernels) {
    return [&kernels, scalars = std::vector<T>(compiled.scalars)](const T* R, const V* f, V* out) mutable {
        kernels.prepare(R, scalars.data());
        kernels.apply(scalars.data(), f, out);
    };
}

/// `blocks` and the product with them.
template <class T>
auto product_with_blocks(const CompiledOrder& compiled) {
    return
        [&compiled, dense = std::vector<T>(compiled.blocks_size())](const T* R, const T* f, T* out) mutable {
            compiled.in<T>().blocks(R, dense.data());
            const T* entry = dense.data();
            for (int l = 0; l < compiled.order; ++l) {
                for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
                    T sum = 0;
                    for (int j = l * l; j < (l + 1) * (l + 1); ++j) sum = std::fma(*entry++, f[j], sum);
                    out[i] = sum;
                }
            }
        };
}

/// What `rotate` runs where a signal value is not of the type of R.
std::string rotate_of_channels(int order) { return order <= 3 ? "rotate" : "rotate_channels"; }

/// Every compiled kernel that turns a signal, in each type of signal that it is compiled for.
template <class T>
std::vector<accuracy::Contestant<T>> contestants(const CompiledOrder& compiled) {
    const int order = compiled.order;
    std::vector<accuracy::Contestant<T>> all;
    const auto add = [&](const std::string& name, auto rotate) {
        if constexpr (std::is_pointer_v<decltype(rotate)>)
            if (rotate == nullptr) throw std::logic_error(name + " is not compiled");
        all.push_back(by_its_words<T>(order, name, rotate));
    };
    if (is_to_have_lobes(order) && compiled.lobes.size() != 3) throw std::logic_error("lobes are gone");
    const RotateKernels<T>& kernels = compiled.in<T>();
    add("rotate", kernels.rotate);
    add("rotate_fewest", kernels.rotate_fewest);
    add("apply", halves(compiled, kernels));
    add("rotate_accurate", kernels.rotate_accurate);
    add("blocks", product_with_blocks<T>(compiled));
    if (is_to_have_tensor(order)) add("rotate_tensor", kernels.rotate_tensor);
    for (const LobeVariant& lobes : compiled.lobes)
        if (lobes.layout != LobeVariant::Layout::per_band)
            add(lobes.prefix + "rotate_zhf", lobes.in<T>().rotate_zhf);
    const std::string of_channels = " of three channels";
    if constexpr (std::is_same_v<T, double>) {
        add(rotate_of_channels(order) + of_channels,
            in_one_of_three_channels<T, Rgb<T>>(order, compiled.rotate_rgb));
    } else {
        const RotateKernels<T, Channels>& several = compiled.in_channels;
        const auto add_channels = [&](const std::string& name, auto rotate) {
            add(name + of_channels, in_one_of_three_channels<T, Channels>(order, rotate));
        };
        add_channels(rotate_of_channels(order), several.rotate);
        add_channels("apply", halves(compiled, several));
        add_channels("rotate_accurate", several.rotate_accurate);
        if (is_to_have_tensor(order)) add_channels("rotate_tensor", several.rotate_tensor);
        for (const LobeVariant& lobes : compiled.lobes)
            if (lobes.layout != LobeVariant::Layout::per_band)
                add_channels(lobes.prefix + "rotate_zhf", lobes.rotate_zhf_channels);
    }
    return all;
}

std::vector<int> orders() {
    std::vector<int> all;
    for (const CompiledOrder& compiled : compiled_orders()) all.push_back(compiled.order);
    return all;
}

class KernelAccuracy : public testing::TestWithParam<int> {};

TEST_P(KernelAccuracy, float_is_within_its_bounds) {
    expect_within_bounds<float>(GetParam(), contestants<float>(compiled_order(GetParam())));
}

/// A form of `rotate` that takes other determinants than another is a trap: V is often a template's.
TEST_P(KernelAccuracy, one_determinant_is_stated_for_every_type_of_signal) {
    const int order = GetParam();
    const bool takes_mirrors = compiled_order(order).takes_mirrors;
    EXPECT_TRUE(takes_mirrors || order >= 4);
    for (const std::string& kernel : {std::string("rotate"), rotate_of_channels(order)}) {
        EXPECT_EQ(banner::bound(order, kernel).takes_mirrors, takes_mirrors) << kernel;
        EXPECT_EQ(banner::comment_takes_mirrors(order, kernel), takes_mirrors) << kernel;
    }
    EXPECT_EQ(banner::bound(order, "apply").takes_mirrors, takes_mirrors);
    EXPECT_TRUE(banner::bound(order, "rotate_accurate").takes_mirrors);
    EXPECT_TRUE(banner::comment_takes_mirrors(order, "rotate_accurate"));
    EXPECT_TRUE(banner::bound(order, "blocks").takes_mirrors);
}

/// V is often a template's: whoever reads of `rotate` alone must not take one form's bound for the other's.
TEST_P(KernelAccuracy, the_bound_of_channels_is_stated_where_another_kernel_rotates_them) {
    const int order = GetParam();
    if (rotate_of_channels(order) == "rotate") {
        EXPECT_ANY_THROW(banner::float_bound_of_channels(order, "rotate"));
        return;
    }
    for (const char* kernel : {"rotate", "rotate_fewest"})
        EXPECT_EQ(banner::float_bound_of_channels(order, kernel),
                  banner::bound(order, rotate_of_channels(order)).float_bound);
}

TEST_P(KernelAccuracy, double_is_within_its_bounds) {
    expect_within_bounds<double>(GetParam(), contestants<double>(compiled_order(GetParam())));
}

/// Squares of what R tells of a pole's direction are lost where denormals are flushed; whatever is lost, the
/// published bounds hold.
template <class T>
void expect_tiny_tilts_within_bounds(int order) {
    constexpr int kSignals = 4;
    const auto problems = accuracy::tiny_tilts(order, kSeed + static_cast<unsigned>(order), kSignals);
    auto kernels = contestants<T>(compiled_order(order));
    for (auto& kernel : kernels) {
        const auto rotate = kernel.rotate;
        kernel.rotate = [rotate](const T* R, const T* f, T* out) {
            const FlushedDenormals flushed;
            rotate(R, f, out);
        };
    }
    const auto worst = accuracy::worst_errors<T>(oracle::Rotation(order), problems, kernels);
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        const banner::Bound bound = banner::bound(order, kernel_of(kernels[k].name));
        const double limit = sizeof(T) == sizeof(float) ? bound.float_bound : bound.double_bound;
        EXPECT_LE(worst[k].error, limit) << kernels[k].name << ", order " << order << ", " << worst[k].name;
    }
}

TEST_P(KernelAccuracy, tiny_tilts_are_within_bounds_where_denormals_are_flushed) {
    if (!FlushedDenormals::kIsSupported) GTEST_SKIP() << "not known how to flush denormals here";
    expect_tiny_tilts_within_bounds<float>(GetParam());
    expect_tiny_tilts_within_bounds<double>(GetParam());
}

/// Errors that few turns of a million have: at orders 2 and 3 they are larger by half than those of
/// thousands.
TEST_P(KernelAccuracy, rare_errors_are_within_bounds) {
    const int order = GetParam();
    auto kernels = contestants<float>(compiled_order(order));
    // At other orders `rotate` is `rotate_fewest`.
    std::set<std::string> judged{"rotate", "apply", "rotate_accurate"};
    if (order == 4) judged.insert("rotate_fewest");
    std::erase_if(kernels, [&](const auto& kernel) { return !judged.contains(kernel.name); });
    ASSERT_EQ(kernels.size(), judged.size());
    const auto judges = contestants<double>(compiled_order(order));
    const auto judge = std::find_if(judges.begin(), judges.end(),
                                    [](const auto& kernel) { return kernel.name == "rotate_accurate"; });
    const auto worst =
        accuracy::worst_of_many_turns(order, kernels, *judge, order <= 3 ? 2000000 : 20000, kSeed + order);
    for (const auto& kernel : kernels)
        EXPECT_LE(worst.at(kernel.name), banner::bound(order, kernel.name).float_bound)
            << kernel.name << ", order " << order;
}

INSTANTIATE_TEST_SUITE_P(orders, KernelAccuracy, testing::ValuesIn(orders()),
                         [](const auto& order) { return fmt::format("order_{}", order.param); });

}  // namespace
}  // namespace zonal
