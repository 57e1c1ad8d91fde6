#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "graph/counts.hpp"
#include "graph/evaluate.hpp"
#include "graph/passes.hpp"
#include "graph/shared_sums.hpp"
#include "graph/sum.hpp"
#include "support/empty_kernel.hpp"

namespace zonal::graph {
namespace {

using Factors = std::vector<std::vector<Number>>;

std::vector<Value> signal_inputs(Kernel& kernel, std::size_t count) {
    std::vector<Value> inputs;
    for (std::size_t k = 0; k < count; ++k) inputs.push_back(kernel.input(1, static_cast<int>(k)));
    return inputs;
}

Kernel with_shared_sums(const Factors& factors) {
    Kernel kernel = empty_kernel();
    SharedSums sums(kernel.graph, factors, signal_inputs(kernel, factors.front().size()));
    for (int i = 0; i < static_cast<int>(factors.size()); ++i) kernel.store(i, sums.output(i), 0);
    return optimize(kernel);
}

Kernel row_by_row(const Factors& factors) {
    Kernel kernel = empty_kernel();
    const std::vector<Value> inputs = signal_inputs(kernel, factors.front().size());
    for (int i = 0; i < static_cast<int>(factors.size()); ++i) {
        std::vector<Term> terms;
        for (std::size_t k = 0; k < inputs.size(); ++k) terms.push_back({factors[i][k], inputs[k]});
        kernel.store(i, linear_combination(kernel.graph, terms), 0);
    }
    return optimize(kernel);
}

Counts counts_of(const Kernel& kernel) { return count_operations(kernel).total(); }

/// A third of the entries are zero; the others are ± one of so few sizes that many agree, and every third row
/// repeats an earlier one in half of its places, times 1, -1 or 3/7.
Factors matrix_with_repetitions(std::mt19937& random, int rows, int columns) {
    const auto below = [&](unsigned n) { return random() % n; };
    Factors factors(rows, std::vector<Number>(columns));
    for (int i = 0; i < rows; ++i) {
        for (Number& factor : factors[i])
            if (below(3) > 0) factor = (below(2) == 0 ? 1 : -1) * sqrt(Number(1 + below(9)));
        const Number times[] = {Number(1), Number(-1), Number(3) / 7};
        const Number by = times[below(3)];
        if (i % 3 == 2)
            for (int k = 0; k < columns; k += 2) factors[i][k] = by * factors[i - 1 - below(2)][k];
        factors[i][below(columns)] = 2;
    }
    return factors;
}

const Number kA = sqrt(Number(2)), kB = sqrt(Number(3)), kC = sqrt(Number(5)), kD = sqrt(Number(7)),
             kE = sqrt(Number(11));

TEST(SharedSums, are_the_product_of_matrix_and_vector) {
    std::mt19937 random(1);
    for (int trial = 0; trial < 50; ++trial) {
        const int rows = 3 + trial % 10, columns = 4 + trial % 7;
        const Factors factors = matrix_with_repetitions(random, rows, columns);
        std::vector<double> in(columns), out(rows);
        for (double& x : in) x = static_cast<int>(random() % 2001) / 1000.0 - 1;
        const Kernel kernel = with_shared_sums(factors);
        Evaluator<double>{kernel}({nullptr, in.data()}, out.data());
        // A term passes each instruction once at most, which rounds and may have a rounded constant.
        const double unit_roundoffs = 2.0 * counts_of(kernel).instructions() + 1;
        for (int i = 0; i < rows; ++i) {
            Number sum = 0, sizes = 0;
            for (int k = 0; k < columns; ++k) {
                sum += factors[i][k] * in[k];
                sizes += abs(factors[i][k] * in[k]);
            }
            EXPECT_LE(abs(sum - out[i]), sizes * unit_roundoffs * 0x1p-53) << "row " << i;
        }
    }
}

TEST(SharedSums, save_what_rows_repeat_and_never_add) {
    std::mt19937 random(2);
    int shared = 0, separate = 0;
    for (int trial = 0; trial < 50; ++trial) {
        const Factors factors = matrix_with_repetitions(random, 12, 12);
        const int with = counts_of(with_shared_sums(factors)).instructions();
        const int without = counts_of(row_by_row(factors)).instructions();
        EXPECT_LE(with, without);
        shared += with;
        separate += without;
    }
    // Every third row repeats about four terms: three of eight instructions of that row.
    EXPECT_LT(shared, (1 - 0.3 / 3) * separate);
}

TEST(SharedSums, a_butterfly_makes_both_of_its_sums_once) {
    const Counts counts = counts_of(with_shared_sums({{kA, kB, kC, kD}, {kA, kB, -kC, -kD}}));
    EXPECT_EQ(counts.instructions(), 5);  // a f + b g in two, f + (d/c) g in one, and one for each row
    EXPECT_EQ(counts.multiplications(), 5);
}

TEST(SharedSums, three_common_terms_are_made_once) {
    const Counts counts = counts_of(with_shared_sums({{kA, kB, kC, kD, 0}, {-kA, -kB, -kC, 0, kE}}));
    EXPECT_EQ(counts.mul, 1);
    EXPECT_EQ(counts.fma, 4);
    EXPECT_EQ(counts.add, 0);
}

TEST(SharedSums, proportional_terms_are_made_once_with_one_factor_less) {
    const Counts counts = counts_of(with_shared_sums({{kA, kB, kC, kD, 0}, {3 * kA, 3 * kB, 3 * kC, 0, kE}}));
    EXPECT_EQ(counts.instructions(), 6);  // two for the sum, two for each row
    EXPECT_EQ(counts.multiplications(), 6);
}

TEST(SharedSums, a_sum_without_factors_serves_rows_with_different_ones) {
    const Counts counts = counts_of(with_shared_sums({{kA, kA, kA, 0}, {kB, kB, 0, kC}}));
    EXPECT_EQ(counts.multiplications(), 3);
    EXPECT_EQ(counts.instructions(), 5);
}

TEST(SharedSums, a_product_that_starts_two_chains_is_made_once) {
    const Counts counts = counts_of(with_shared_sums({{kA, kB}, {kA, -kC}}));
    EXPECT_EQ(counts.mul, 1);
    EXPECT_EQ(counts.fma, 2);
    EXPECT_EQ(counts.add, 0);
}

TEST(SharedSums, one_multiplication_is_not_traded_for_two_additions) {
    const Counts counts = counts_of(with_shared_sums({{kA, 1, 0}, {kA, 0, 1}}));
    EXPECT_EQ(counts.fma, 2);
    EXPECT_EQ(counts.instructions(), 2);
}

TEST(SharedSums, a_row_and_its_negative_cost_one_row) {
    EXPECT_EQ(counts_of(with_shared_sums({{kA, kB, kC}, {-kA, -kB, -kC}})).instructions(), 3);
}

TEST(SharedSums, nothing_in_common_costs_what_it_costs_row_by_row) {
    const Factors factors{{kA, kB, 1}, {kC, kD, kE}, {-1, 0, 1}};
    const Counts with = counts_of(with_shared_sums(factors)), without = counts_of(row_by_row(factors));
    EXPECT_EQ(with.mul, without.mul);
    EXPECT_EQ(with.fma, without.fma);
    EXPECT_EQ(with.add, without.add);
}

TEST(SharedSums, are_found_the_same_twice) {
    std::mt19937 random(3);
    const Factors factors = matrix_with_repetitions(random, 15, 15);
    const Kernel once = with_shared_sums(factors), twice = with_shared_sums(factors);
    ASSERT_EQ(once.graph.size(), twice.graph.size());
    for (Id id = 0; id < once.graph.size(); ++id) {
        EXPECT_EQ(once.graph[id].op, twice.graph[id].op);
        EXPECT_EQ(once.graph[id].operands, twice.graph[id].operands);
    }
}

TEST(Sizes, differ_in_more_than_the_last_digits) {
    Sizes sizes;
    EXPECT_EQ(sizes.number_of(1), Sizes::kUnit);
    const int third = sizes.number_of(Number(1) / 3);
    EXPECT_EQ(sizes.number_of(-Number(1) / 3 - Number("1e-40")), third);
    EXPECT_NE(sizes.number_of(Number(1) / 3 + Number("1e-30")), third);
    EXPECT_EQ(sizes.quotient(sizes.number_of(2), sizes.number_of(6)), third);
}

}  // namespace
}  // namespace zonal::graph
