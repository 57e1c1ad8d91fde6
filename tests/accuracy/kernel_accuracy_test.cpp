// Every compiled kernel that turns a signal against the pointwise oracle, float and double: the numbers the
// project promises. Orders above those compiled: graph_accuracy_test.
#include <gtest/gtest.h>

#include "support/accuracy.hpp"
#include "support/banner.hpp"
#include "support/kernels.hpp"
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
        // Noise in R costs `rotate` of order 3 up to 2.12 ‖R Rᵀ - I‖_F (README), and the contract grants 1.
        // Single bands show it.
        if (order == 3 && kIsFloat && name == "rotate") continue;
        EXPECT_LE(worst[k].error_of_bands, accuracy::contract(name, order, kIsFloat))
            << name << ", order " << order << ", " << worst[k].name_of_bands;
    }
}

template <int N, class T>
std::vector<accuracy::Contestant<T>> compiled_kernels() {
    std::vector<accuracy::Contestant<T>> kernels;
    const auto add = [&](const std::string& name, auto rotate) {
        const accuracy::Contestant<T> kernel{name, rotate, banner::bound(N, name).excess};
        const bool takes_mirrors = name == "rotate_accurate" || Order<N>::kTakesMirrors;
        kernels.push_back(takes_mirrors ? kernel : accuracy::with_mirrors(N, kernel));
    };
    add("rotate", [](const T* R, const T* f, T* out) { Order<N>::rotate(R, f, out); });
    add("apply", [](const T* R, const T* f, T* out) {
        T scalars[Order<N>::kScalars];
        Order<N>::prepare(R, scalars);
        Order<N>::apply(scalars, f, out);
    });
    add("rotate_accurate", [](const T* R, const T* f, T* out) { Order<N>::rotate_accurate(R, f, out); });
    return kernels;
}

/// Errors that few turns of a million have: at orders 2 and 3 they are larger by half than those of
/// thousands.
template <int N>
void expect_rare_errors_within_bounds() {
    const auto kernels = compiled_kernels<N, float>();
    const auto worst = accuracy::worst_of_many_turns(N, kernels, compiled_kernels<N, double>().back(),
                                                     N <= 3 ? 2000000 : 20000, kSeed + N);
    for (const auto& kernel : kernels)
        EXPECT_LE(worst.at(kernel.name), banner::bound(N, kernel.name).float_bound)
            << kernel.name << ", order " << N;
}

#define ZONAL_ACCURACY_TESTS(N)                                          \
    TEST(KernelAccuracy, order_##N##_float_is_within_its_bounds) {       \
        expect_within_bounds<float>(N, compiled_kernels<N, float>());    \
    }                                                                    \
    TEST(KernelAccuracy, order_##N##_double_is_within_its_bounds) {      \
        expect_within_bounds<double>(N, compiled_kernels<N, double>());  \
    }                                                                    \
    TEST(KernelAccuracy, rare_errors_of_order_##N##_are_within_bounds) { \
        expect_rare_errors_within_bounds<N>();                           \
    }
ZONAL_FOR_EACH_ORDER(ZONAL_ACCURACY_TESTS)

/// Mirrors are its own: it is given them as they are.
template <int N, class T>
std::vector<accuracy::Contestant<T>> polynomial_kernel() {
    return {{"rotate_polynomial",
             [](const T* R, const T* f, T* out) { PolynomialOrder<N>::rotate(R, f, out); },
             banner::bound(N, "rotate_polynomial").excess}};
}

#define ZONAL_POLYNOMIAL_ACCURACY_TESTS(N)                                    \
    TEST(KernelAccuracy, polynomial_of_order_##N##_float_is_within_bounds) {  \
        expect_within_bounds<float>(N, polynomial_kernel<N, float>());        \
    }                                                                         \
    TEST(KernelAccuracy, polynomial_of_order_##N##_double_is_within_bounds) { \
        expect_within_bounds<double>(N, polynomial_kernel<N, double>());      \
    }
ZONAL_FOR_EACH_POLYNOMIAL_ORDER(ZONAL_POLYNOMIAL_ACCURACY_TESTS)

template <int N, class T>
std::vector<accuracy::Contestant<T>> lobe_kernels() {
    return {
        {"rotate_zhf", [](const T* R, const T* f, T* out) { LobeOrder<N>::rotate_zhf(R, f, out); },
         banner::bound(N, "rotate_zhf").excess},
        {"stable::rotate_zhf", [](const T* R, const T* f, T* out) { StableOrder<N>::rotate_zhf(R, f, out); },
         banner::bound(N, "stable::rotate_zhf").excess}};
}

#define ZONAL_LOBE_ACCURACY_TESTS(N)                                      \
    TEST(KernelAccuracy, lobes_of_order_##N##_float_are_within_bounds) {  \
        expect_within_bounds<float>(N, lobe_kernels<N, float>());         \
    }                                                                     \
    TEST(KernelAccuracy, lobes_of_order_##N##_double_are_within_bounds) { \
        expect_within_bounds<double>(N, lobe_kernels<N, double>());       \
    }
ZONAL_FOR_EACH_LOBE_ORDER(ZONAL_LOBE_ACCURACY_TESTS)

}  // namespace
}  // namespace zonal
