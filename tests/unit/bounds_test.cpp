// Which bound a kernel publishes, and what is derived beside it.
#include <gtest/gtest.h>

#include <cmath>

#include "bounds/body_hash.hpp"
#include "bounds/derived.hpp"
#include "bounds/published.hpp"
#include "support/built_order.hpp"

namespace zonal {
namespace {

using graph::Kernel;
using graph::Kind;
using graph::Number;
using graph::Value;

Kernel kernel_of(int scalars, int signals) {
    Kernel kernel;
    kernel.name = "rotate";
    kernel.inputs = {{"R", Kind::rotation, scalars, ""}, {"f", Kind::signal, signals, ""}};
    kernel.output = {"out", Kind::signal, 1, ""};
    return kernel;
}

TEST(DerivedBound, of_a_product_with_a_row_counts_its_roundings) {
    // (r0 f0 + r1 f1) + r2 f2: the first product is rounded three times, the second twice apart from its own.
    Kernel kernel = kernel_of(3, 3);
    graph::Graph& graph = kernel.graph;
    const auto r = [&](int i) { return kernel.input(0, i).id; };
    const auto f = [&](int i) { return kernel.input(1, i).id; };
    const graph::Id first = graph.multiply(r(0), f(0));
    const graph::Id second = graph.fused(r(1), f(1), first, false, false);
    kernel.store(0, {&graph, graph.fused(r(2), f(2), second, false, false)}, 0);
    const DerivedBound bound = derived_bound(kernel).value();
    // One row (3, 2, 1), apart (3, 3, 2): the root of its sum times its largest entry.
    EXPECT_DOUBLE_EQ(bound.fused, std::sqrt(6.0 * 3));
    EXPECT_DOUBLE_EQ(bound.apart, std::sqrt(8.0 * 3));
}

TEST(DerivedBound, counts_no_rounding_where_there_is_none) {
    Kernel kernel = kernel_of(1, 1);
    kernel.store(0, -(Number(0.25) * kernel.input(1, 0)), 0);
    EXPECT_EQ(derived_bound(kernel).value().apart, 0);
}

TEST(DerivedBound, knows_that_constants_are_rounded) {
    Kernel exact = kernel_of(1, 1), rounded = kernel_of(1, 1);
    exact.store(0, Number(3) * exact.input(1, 0), 0);
    rounded.store(0, sqrt(Number(9) + Number("1e-20")) * rounded.input(1, 0), 0);
    EXPECT_DOUBLE_EQ(derived_bound(exact).value().fused, 3);
    EXPECT_DOUBLE_EQ(derived_bound(rounded).value().fused, 6);
}

TEST(DerivedBound, takes_what_a_builder_knows_of_a_size) {
    const auto bound_where_sum_is_at_most = [](double most) {
        Kernel kernel = kernel_of(2, 1);
        const Value sum = kernel.input(0, 0) + kernel.input(0, 1);
        kernel.graph.set_most(sum.id, most);
        kernel.store(0, sum * kernel.input(1, 0), 0);
        return derived_bound(kernel).value().fused;
    };
    EXPECT_DOUBLE_EQ(bound_where_sum_is_at_most(5), 4);  // the sum is at most 2
    EXPECT_DOUBLE_EQ(bound_where_sum_is_at_most(1), 3);
}

TEST(DerivedBound, there_is_none_of_a_quotient_or_a_root) {
    Kernel kernel = kernel_of(1, 1);
    kernel.store(0, (Number(1) / kernel.input(0, 0)) * kernel.input(1, 0), 0);
    EXPECT_FALSE(derived_bound(kernel).has_value());
    const OrderKernels& order = built_order(4);
    EXPECT_FALSE(derived_bound(graph::kernel_named(order.kernels, "rotate_fewest")).has_value());
}

TEST(BodyHash, is_of_the_arithmetic_and_of_nothing_else) {
    const auto sum = [](const char* name, const char* kernel_name, double factor) {
        Kernel kernel = kernel_of(1, 2);
        kernel.name = kernel_name;
        const Value product = Number(factor) * kernel.input(1, 0);
        kernel.graph.set_name(product.id, name);
        kernel.store(0, product + kernel.input(1, 1), 0);
        return body_hash(kernel, {});
    };
    EXPECT_EQ(sum("a", "rotate", 0.3), sum("b", "rotate_tensor", 0.3));
    EXPECT_NE(sum("a", "rotate", 0.3), sum("a", "rotate", 0.7));
}

TEST(BodyHash, of_apply_is_of_what_prepares_it_too) {
    std::vector<Kernel> kernels = built_order(5).kernels;
    const Kernel apply = graph::kernel_named(kernels, "apply");
    const std::string before = body_hash(apply, kernels);
    for (Kernel& kernel : kernels)
        if (kernel.name == "prepare") kernel.stores.pop_back();
    EXPECT_NE(body_hash(apply, kernels), before);
}

TEST(PublishedBounds, a_kernel_that_changed_has_none) {
    OrderKernels order = built_order(3);
    EXPECT_NO_THROW(published_bounds(order));
    for (Kernel& kernel : order.kernels)
        if (kernel.name == "rotate_accurate")
            std::swap(kernel.stores.front().value, kernel.stores.back().value);
    EXPECT_ANY_THROW(published_bounds(order));
}

}  // namespace
}  // namespace zonal
