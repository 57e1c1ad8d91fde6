// Every kernel of every order, 2 … 20, run from its graph: float and double against the oracle, within the
// published bounds and the contract. The full set of rotations is what zonal-measure-bounds ran; here are
// fewer at high orders.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bounds/published.hpp"
#include "support/arithmetic.hpp"
#include "support/built_order.hpp"
#include "support/graph_kernels.hpp"

namespace zonal {
namespace {

template <class T>
void expect_within_bounds(int order) {
    constexpr bool kIsFloat = std::is_same_v<T, float>;
    const OrderKernels& kernels = built_order(order);
    const auto bounds = published_bounds(kernels);
    std::map<std::string, double> excess;
    for (const auto& [name, bound] : bounds) excess[name] = std::stod(bound.excess_text);
    const int random_count = order <= 10 ? 300 : 30;
    auto problems = accuracy::problems<T>(order, random_count, 30, 7 * order);
    if (order > 10) {  // the oracle's time grows as order^4
        const std::size_t step = order <= 14 ? 3 : 6;
        std::size_t number = 0;
        std::erase_if(problems, [&](const accuracy::Problem&) { return number++ % step != 0; });
    }
    const auto contestants = graph_contestants<T>(order, kernels.kernels, excess);
    ASSERT_GE(contestants.size(), 4u);
    ASSERT_EQ(contestants.size(), bounds.size()) << "a kernel is gone that publishes a bound";
    const auto worst = accuracy::worst_errors<T>(oracle::Rotation(order), problems, contestants);
    for (std::size_t k = 0; k < contestants.size(); ++k) {
        const std::string& name = contestants[k].name;
        ASSERT_TRUE(bounds.contains(name)) << name << ", order " << order << ": no bound is published";
        const Bound& bound = bounds.at(name);
        EXPECT_LE(worst[k].error, std::stod(kIsFloat ? bound.float_text : bound.double_text))
            << name << ", order " << order << ", " << worst[k].name;
        EXPECT_LE(worst[k].error_of_rotations, accuracy::contract(name, order, kIsFloat))
            << name << ", order " << order << ", " << worst[k].name_of_rotations;
        // A band whose lobes have a high condition is far worse than the whole signal tells.
        if (name != "rotate_zhf") continue;
        EXPECT_LE(worst[k].error_of_bands, accuracy::contract(name, order, kIsFloat))
            << name << ", order " << order << ", " << worst[k].name_of_bands;
    }
}

class GraphAccuracy : public testing::TestWithParam<int> {};
TEST_P(GraphAccuracy, float_is_within_bounds) { expect_within_bounds<float>(GetParam()); }
TEST_P(GraphAccuracy, double_is_within_bounds) { expect_within_bounds<double>(GetParam()); }

TEST_P(GraphAccuracy, measured_bounds_are_within_derived_ones) {
    const auto bounds = published_bounds(built_order(GetParam()));
    for (const auto& [kernel, bound] : bounds) {
        if (bound.float_derived.empty()) continue;
        const auto expect_within = [&, name = kernel](const std::string& measured,
                                                      const std::string& derived) {
            EXPECT_LE(std::stod(measured), std::stod(derived)) << name;
        };
        expect_within(bound.float_text, bound.float_derived);
        expect_within(bound.double_text, bound.double_derived);
        expect_within(bound.float_apart, bound.float_apart_derived);
        expect_within(bound.double_apart, bound.double_apart_derived);
    }
    if (GetParam() > 4) return;
    for (const char* kernel : {"rotate_tensor", "rotate_accurate"})
        EXPECT_NE(bounds.at(kernel).float_derived, "") << kernel;
}

TEST_P(GraphAccuracy, bounds_grow_with_what_an_arithmetic_may_do) {
    for (const auto& [kernel, bound] : published_bounds(built_order(GetParam()))) {
        EXPECT_LE(std::stod(bound.float_text), std::stod(bound.float_apart)) << kernel;
        EXPECT_LE(std::stod(bound.double_text), std::stod(bound.double_apart)) << kernel;
        EXPECT_LE(std::stod(bound.float_apart), std::stod(bound.shader)) << kernel;
    }
}

/// Products and sums rounded apart, and quotients and roots as inexact as shaders may have them.
TEST_P(GraphAccuracy, other_arithmetic_is_within_bounds) {
    const int order = GetParam();
    const OrderKernels& kernels = built_order(order);
    const auto bounds = published_bounds(kernels);
    std::map<std::string, double> excess;
    for (const auto& [name, bound] : bounds) excess[name] = std::stod(bound.excess_text);
    const auto problems = accuracy::problems<float>(order, order <= 10 ? 100 : 5, 100, 11 * order);
    const auto judge = [&](const auto& contestants, std::string Bound::*published) {
        ASSERT_EQ(contestants.size(), bounds.size());
        const auto worst = accuracy::worst_errors<float>(oracle::Rotation(order), problems, contestants);
        for (std::size_t k = 0; k < contestants.size(); ++k)
            EXPECT_LE(worst[k].error, std::stod(bounds.at(contestants[k].name).*published))
                << contestants[k].name << ", " << worst[k].name;
    };
    using arithmetic::Allowed, arithmetic::Apart;
    judge(graph_contestants<float, Apart>(order, kernels.kernels, excess), &Bound::float_apart);
    judge(graph_contestants<float, Allowed<Apart>>(order, kernels.kernels, excess), &Bound::shader);
}

INSTANTIATE_TEST_SUITE_P(orders, GraphAccuracy, testing::Range(2, 21),
                         [](const auto& order) { return fmt::format("order_{}", order.param); });

}  // namespace
}  // namespace zonal
