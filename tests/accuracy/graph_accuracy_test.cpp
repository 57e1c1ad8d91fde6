// Every kernel of every order, 2 … 20, run from its graph: float and double against the oracle, within the
// published bounds and the contract. The full set of rotations is what zonal-measure-bounds ran; here are
// fewer at high orders.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "bounds/published.hpp"
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
INSTANTIATE_TEST_SUITE_P(orders, GraphAccuracy, testing::Range(2, 21),
                         [](const auto& order) { return fmt::format("order_{}", order.param); });

}  // namespace
}  // namespace zonal
