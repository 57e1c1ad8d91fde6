#include <gtest/gtest.h>

#include <vector>

#include "exact/matrix.hpp"
#include "search/column_sums.hpp"
#include "search/random.hpp"

namespace zonal::search {
namespace {

constexpr int kRows = 2 * kPackedRows;

/// A matrix whose last rows are padding, with some zeros.
exact::Matrix<double> padded_matrix(int size, Random& random) {
    exact::Matrix<double> matrix = exact::Matrix<double>::Zero(kRows, size);
    for (int j = 0; j < size; ++j)
        for (int i = 0; i < size; ++i) matrix(i, j) = random.chance(0.3) ? 0.0 : random.uniform() - 0.5;
    return matrix;
}

TEST(ColumnSums, weights_are_products_with_the_columns) {
    Random random(1, 0);
    for (const int size : {9, 11, 16}) {
        const exact::Matrix<double> matrix = padded_matrix(size, random);
        exact::Vector<double> row = exact::Vector<double>::Zero(kRows), weights(size);
        for (int i = 0; i < size; ++i) row(i) = random.uniform();
        multiply_columns(matrix.data(), kRows, size, row.data(), weights.data());
        EXPECT_LT((weights - matrix.transpose() * row).norm(), 1e-14 * size);
    }
}

TEST(ColumnSums, count_of_a_swap_is_the_count_of_the_swapped_matrix) {
    Random random(2, 0);
    for (int trial = 0; trial < 20; ++trial) {
        const int size = 13, pivot = random.below(size);
        const exact::Matrix<double> matrix = padded_matrix(size, random);
        exact::Vector<double> weights(size);
        for (int j = 0; j < size; ++j) weights(j) = random.chance(0.5) ? 0.0 : random.uniform() + 0.1;
        weights(pivot) = 0.25;
        exact::Matrix<double> swapped = matrix;
        for (int j = 0; j < size; ++j)
            if (j != pivot) swapped.col(j) -= weights(j) / weights(pivot) * matrix.col(pivot);
        swapped.col(pivot) /= weights(pivot);
        const ColumnSums wanted = count(swapped.data(), kRows, size);
        const ColumnSums sums = count_after_swap(matrix.data(), kRows, size, pivot, weights.data());
        EXPECT_EQ(sums.nonzeros, wanted.nonzeros);
        EXPECT_NEAR(sums.squared_norm, wanted.squared_norm, 1e-12 * wanted.squared_norm);
        EXPECT_NEAR(sums.squared_norm, swapped.squaredNorm(), 1e-12 * swapped.squaredNorm());
    }
}

TEST(ColumnSums, tiny_entries_and_padding_are_zeros) {
    std::vector<double> matrix(kPackedRows * 2, 0.0);
    matrix[0] = 1;
    matrix[1] = 1e-10;
    matrix[kPackedRows] = -0.5;
    EXPECT_EQ(count(matrix.data(), kPackedRows, 2).nonzeros, 2);
    EXPECT_EQ(count(matrix.data(), kPackedRows, 2).squared_norm, 1.25 + 1e-20);
}

}  // namespace
}  // namespace zonal::search
