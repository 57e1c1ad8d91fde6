#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "emit/text.hpp"
#include "graph/counts.hpp"
#include "graph/passes.hpp"
#include "graph/schedule.hpp"
#include "graph/sum.hpp"
#include "support/empty_kernel.hpp"

namespace zonal::graph {
namespace {

TEST(Graph, constants_fold) {
    Graph graph;
    const Id two = graph.constant(2), three = graph.constant(3);
    EXPECT_EQ(graph[graph.add(two, three)].value, 5);
    EXPECT_EQ(graph[graph.subtract(two, three)].value, -1);
    EXPECT_EQ(graph[graph.multiply(two, three)].value, 6);
}

TEST(Graph, zero_one_and_minus_one_cost_nothing) {
    Graph graph;
    const Id x = graph.input(Kind::rotation, 0, 0);
    EXPECT_EQ(graph.multiply(graph.constant(1), x), x);
    EXPECT_EQ(graph.add(x, graph.constant(0)), x);
    EXPECT_EQ(graph[graph.multiply(graph.constant(0), x)].value, 0);
    EXPECT_EQ(graph[graph.multiply(graph.constant(-1), x)].op, Op::negate);
    EXPECT_EQ(graph.negate(graph.negate(x)), x);
}

TEST(Graph, equal_expressions_are_one_node_whatever_their_order_and_sign) {
    Graph graph;
    const Id x = graph.input(Kind::rotation, 0, 0), y = graph.input(Kind::rotation, 0, 1);
    EXPECT_EQ(graph.multiply(x, y), graph.multiply(y, x));
    EXPECT_EQ(graph.add(x, y), graph.add(y, x));
    const Id plus = graph.multiply(graph.constant(Number("0.3")), x);
    const Id minus = graph.multiply(graph.constant(Number("-0.3")), x);
    EXPECT_EQ(graph.negate(minus), plus);
}

TEST(Graph, a_difference_and_its_negative_are_one_node) {
    Graph graph;
    const Id x = graph.input(Kind::rotation, 0, 0), y = graph.input(Kind::rotation, 0, 1);
    EXPECT_EQ(graph.negate(graph.subtract(x, y)), graph.subtract(y, x));
}

TEST(Graph, a_signal_has_no_quotient_root_or_sign) {
    Graph graph;
    const Id r = graph.input(Kind::rotation, 0, 0), f = graph.input(Kind::signal, 1, 0);
    EXPECT_THROW(graph.divide(r, f), std::logic_error);
    EXPECT_THROW(graph.square_root(f), std::logic_error);
    EXPECT_THROW(graph.copy_sign(1, 1, f), std::logic_error);
    EXPECT_EQ(graph[graph.divide(r, graph.square_root(r))].kind, Kind::rotation);
}

TEST(Counts, divisions_and_roots_are_other_and_a_copied_sign_is_nothing) {
    Kernel kernel = empty_kernel();
    const Value x = kernel.input(0, 0);
    kernel.store(0, (x / sqrt(x + copysign(Number(1), Number(1), x))) * kernel.input(1, 0), 0);
    const Cost cost = count_operations(kernel);
    EXPECT_EQ(cost.per_rotation.other, 2);
    EXPECT_EQ(cost.per_rotation.add, 1);
    EXPECT_EQ(cost.per_vector.mul, 1);
}

TEST(SplitByKind, halves_hand_over_the_scalars_that_signals_meet) {
    Kernel kernel = empty_kernel();
    const Value a = kernel.input(0, 0) * kernel.input(0, 1);
    kernel.store(0, a * kernel.input(1, 0) + kernel.input(0, 2) * kernel.input(1, 1), 0);
    const Halves halves = split_by_kind(optimize(kernel));
    EXPECT_EQ(halves.prepare.output.size, 2);  // the product and the third entry of R
    EXPECT_EQ(count_operations(halves.prepare).total().mul, 1);
    EXPECT_EQ(count_operations(halves.apply).per_rotation.instructions(), 0);
    EXPECT_EQ(count_operations(halves.apply).per_vector.instructions(), 2);
}

TEST(Spills, values_that_wait_beyond_the_registers_go_to_memory_and_back) {
    // Four sums that wait for each other: three registers are one too few, and one value goes and comes back.
    Kernel kernel = empty_kernel();
    std::vector<Value> sums;
    for (int i = 0; i < 4; ++i) sums.push_back(kernel.input(1, i) + kernel.input(1, i + 1));
    kernel.store(0, (sums[0] + sums[1]) + (sums[2] + sums[3]), 0);
    const std::vector<Statement> statements = schedule(kernel);
    EXPECT_EQ(simulate_spills(kernel, statements, 4).stores, 0);
    const Spills few = simulate_spills(kernel, statements, 3);
    EXPECT_EQ(few.stores, 1);
    EXPECT_EQ(few.reloads, 1);
}

TEST(Graph, what_is_not_linear_in_the_signal_cannot_be_built) {
    Graph graph;
    const Id r = graph.input(Kind::rotation, 0, 0), f = graph.input(Kind::signal, 1, 0);
    EXPECT_EQ(graph[graph.multiply(f, r)].operands[0], r);  // the scalar stands on the left
    EXPECT_THROW(graph.multiply(f, f), std::logic_error);
    EXPECT_THROW(graph.add(f, r), std::logic_error);
    EXPECT_THROW(graph.subtract(r, f), std::logic_error);
}

TEST(Sum, factors_of_equal_size_are_multiplied_once) {
    Kernel kernel = empty_kernel();
    const Number third = Number(1) / 3;
    kernel.store(0,
                 linear_combination(kernel.graph, {{third, kernel.input(1, 0)},
                                                   {-third, kernel.input(1, 1)},
                                                   {1, kernel.input(1, 2)},
                                                   {0, kernel.input(1, 3)},
                                                   {-1, kernel.input(1, 4)}}),
                 0);
    const Counts counts = count_operations(optimize(kernel)).total();
    EXPECT_EQ(counts.mul, 0);
    EXPECT_EQ(counts.fma, 1);
    EXPECT_EQ(counts.add, 2);
}

TEST(Passes, a_product_used_by_sums_only_is_fused_into_each) {
    Kernel kernel = empty_kernel();
    const Value product = kernel.input(0, 0) * kernel.input(1, 0);
    kernel.store(0, product + kernel.input(1, 1), 0);
    kernel.store(1, kernel.input(1, 2) - product, 0);
    const Kernel optimized = optimize(kernel);
    const Counts counts = count_operations(optimized).total();
    EXPECT_EQ(counts.fma, 2);
    EXPECT_EQ(counts.instructions(), 2);
    EXPECT_TRUE(optimized.graph[optimized.stores[1].value].negated_product);
}

TEST(Passes, a_product_that_is_stored_stays_and_is_added) {
    Kernel kernel = empty_kernel();
    const Value product = kernel.input(0, 0) * kernel.input(1, 0);
    kernel.store(0, product, 0);
    kernel.store(1, product + kernel.input(1, 1), 0);
    const Counts counts = count_operations(optimize(kernel)).total();
    EXPECT_EQ(counts.mul, 1);
    EXPECT_EQ(counts.add, 1);
    EXPECT_EQ(counts.fma, 0);
}

TEST(Passes, a_minus_sign_before_an_output_moves_into_the_instruction) {
    Kernel kernel = empty_kernel();
    const Number half = Number(1) / 2, third = Number(1) / 3;
    kernel.store(
        0, linear_combination(kernel.graph, {{-half, kernel.input(1, 0)}, {-third, kernel.input(1, 1)}}), 0);
    const Kernel optimized = optimize(kernel);
    EXPECT_EQ(optimized.graph[optimized.stores[0].value].op, Op::fused);
    EXPECT_EQ(count_operations(optimized).total().instructions(), 2);
}

TEST(Passes, what_no_output_needs_is_dropped) {
    Kernel kernel = empty_kernel();
    const Value used = kernel.input(1, 0) + kernel.input(1, 1);
    (void)(used * kernel.input(0, 0));
    kernel.store(0, used, 0);
    EXPECT_EQ(count_operations(optimize(kernel)).total().instructions(), 1);
}

TEST(Counts, split_what_is_paid_per_rotation_from_what_is_paid_per_vector) {
    Kernel kernel = empty_kernel();
    const Value square = kernel.input(0, 0) * kernel.input(0, 0);
    kernel.store(0, square * kernel.input(1, 0) + kernel.input(1, 1), 0);
    const Cost cost = count_operations(optimize(kernel));
    EXPECT_EQ(cost.per_rotation.mul, 1);
    EXPECT_EQ(cost.per_rotation.instructions(), 1);
    EXPECT_EQ(cost.per_vector.fma, 1);
    EXPECT_EQ(cost.per_vector.instructions(), 1);
}

TEST(Schedule, reading_what_an_earlier_group_wrote_is_not_safe_in_place) {
    Kernel safe = empty_kernel();
    safe.store(0, safe.input(1, 0) + safe.input(1, 1), 0);
    safe.store(1, safe.input(1, 0) - safe.input(1, 1), 0);
    EXPECT_TRUE(is_safe_in_place(safe, schedule(safe), 1));

    Kernel unsafe = empty_kernel();
    unsafe.store(0, unsafe.input(1, 0) + unsafe.input(1, 1), 0);
    unsafe.store(1, unsafe.input(1, 0) - unsafe.input(1, 1), 1);
    EXPECT_FALSE(is_safe_in_place(unsafe, schedule(unsafe), 1));
}

TEST(Schedule, peak_live_values_counts_what_waits_to_be_used) {
    Kernel kernel = empty_kernel();
    const Value a = kernel.input(1, 0) + kernel.input(1, 1), b = kernel.input(1, 2) + kernel.input(1, 3),
                c = kernel.input(1, 4) + kernel.input(1, 5);
    kernel.store(0, (a + b) + c, 0);
    EXPECT_EQ(peak_live_values(kernel, schedule(kernel)), 3);
}

TEST(Text, literals_read_back_as_the_nearest_double) {
    EXPECT_EQ(emit::literal(Number(2)), "2.0");
    EXPECT_EQ(emit::literal(Number(1) / 2), "0.5");
    EXPECT_EQ(std::stod(emit::literal(Number(1) / 3)), 1.0 / 3);
    EXPECT_EQ(std::stod(emit::literal(sqrt(Number(2)))), std::sqrt(2.0));
}

TEST(Text, names_are_unique_and_keep_their_meaning) {
    Kernel kernel = empty_kernel();
    kernel.graph.set_scope("b1");
    const Value named = kernel.input(1, 0) + kernel.input(1, 1);
    kernel.graph.set_name(named.id, "b1_1");
    const Value other = kernel.input(1, 0) - kernel.input(1, 1);
    const auto names = emit::node_names(kernel);
    EXPECT_EQ(names.at(named.id), "b1_1");
    EXPECT_NE(names.at(other.id), "b1_1");
}

}  // namespace
}  // namespace zonal::graph
