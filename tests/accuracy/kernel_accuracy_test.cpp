// Every compiled kernel that turns a signal against the pointwise oracle, float and double: the numbers the
// project promises. Orders above those compiled: graph_accuracy_test.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "support/accuracy.hpp"
#include "support/banner.hpp"
#include "support/compiled_kernels.hpp"
#include "support/flushed_denormals.hpp"
#include "support/many_turns.hpp"

namespace zonal {
namespace {

constexpr std::uint64_t kSeed = 20240611;

/// Within the published bound, what R excuses being what the banner says; for rotations within the contract
/// too.
template <class T>
void expect_within_bounds(int order, const std::vector<accuracy::Contestant<T>>& kernels) {
    constexpr bool kIsFloat = std::is_same_v<T, float>;
    const int random_count = order <= 6 ? 10000 : 1000, thinning = order <= 6 ? 1 : 10;
    const auto problems = accuracy::problems<T>(order, random_count, thinning, kSeed + order);
    const auto worst = accuracy::worst_errors<T>(oracle::Rotation(order), problems, kernels);
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        const std::string& name = kernels[k].name;
        const banner::Bound bound = banner::bound(order, name);
        EXPECT_LE(worst[k].error, kIsFloat ? bound.float_bound : bound.double_bound)
            << name << ", order " << order << ", " << worst[k].name;
        // Order 2 in float, a product with R of three roundings a row, exceeds the contract by 2 % in one
        // case of 60 000: only what is published is held there.
        if (order == 2 && kIsFloat) continue;
        EXPECT_LE(worst[k].error_of_rotations, accuracy::contract(name, order, kIsFloat))
            << name << ", order " << order << ", " << worst[k].name_of_rotations;
        // Noise in R costs `rotate` of order 3 up to 2.12 ‖R Rᵀ - I‖_F (tests/bench/README.md), and the
        // contract grants 1. Single bands show it.
        if (order == 3 && kIsFloat && name == "rotate") continue;
        EXPECT_LE(worst[k].error_of_bands, accuracy::contract(name, order, kIsFloat))
            << name << ", order " << order << ", " << worst[k].name_of_bands;
    }
}

/// Every compiled kernel that turns a signal.
template <class T>
std::vector<accuracy::Contestant<T>> contestants(const CompiledOrder& compiled) {
    std::vector<accuracy::Contestant<T>> all;
    const RotateKernels<T>& kernels = compiled.in<T>();
    const auto add = [&](const std::string& name, auto rotate, bool takes_mirrors) {
        if constexpr (std::is_pointer_v<decltype(rotate)>)
            if (rotate == nullptr) return;
        const accuracy::Contestant<T> kernel{name, rotate, banner::bound(compiled.order, name).excess};
        all.push_back(takes_mirrors ? kernel : accuracy::with_mirrors(compiled.order, kernel));
    };
    add("rotate", kernels.rotate, compiled.takes_mirrors);
    const auto halves = [&kernels, scalars = std::vector<T>(compiled.scalars)](const T* R, const T* f,
                                                                               T* out) mutable {
        kernels.prepare(R, scalars.data());
        kernels.apply(scalars.data(), f, out);
    };
    add("apply", halves, compiled.takes_mirrors);
    add("rotate_accurate", kernels.rotate_accurate, true);
    // Mirrors are its own: it is given them as they are.
    if (compiled.has_polynomial()) add("rotate_polynomial", kernels.rotate_polynomial, true);
    for (const LobeVariant& lobes : compiled.lobes)
        if (lobes.layout != LobeVariant::Layout::per_band)
            add(lobes.prefix + "rotate_zhf", lobes.in<T>().rotate_zhf, true);
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

TEST_P(KernelAccuracy, double_is_within_its_bounds) {
    expect_within_bounds<double>(GetParam(), contestants<double>(compiled_order(GetParam())));
}

/// Squares of what R tells of a pole's direction are lost where denormals are flushed; whatever is lost, the
/// published bounds hold.
template <class T>
void expect_tiny_tilts_within_bounds(int order) {
    constexpr int kSignals = 4;
    std::mt19937_64 random(kSeed + static_cast<unsigned>(order));
    std::vector<accuracy::Problem> problems;
    for (const cases::Case& tilt : cases::tiny_tilts(random))
        for (int k = 0; k < kSignals; ++k)
            problems.push_back({tilt.name, tilt.rotation, cases::random_signal(order, random)});
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
        const banner::Bound bound = banner::bound(order, kernels[k].name);
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
    std::erase_if(kernels, [](const auto& kernel) {
        return kernel.name != "rotate" && kernel.name != "apply" && kernel.name != "rotate_accurate";
    });
    ASSERT_EQ(kernels.size(), 3u);
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
