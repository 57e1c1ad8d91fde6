#pragma once

namespace zonal::search {

/// What is counted of a matrix.
struct ColumnSums {
    int nonzeros = 0;  ///< entries of at least `kZeroInDouble`
    double squared_norm = 0;
};

/// Rows of a matrix below are padded with zeros to a multiple of this.
inline constexpr int kPackedRows = 8;

/// weights_j = (column j) . row, for `columns` columns of `rows` values, one after another.
void multiply_columns(const double* matrix, int rows, int columns, const double* row, double* weights);

/// Counts the matrix that a rank-one change would leave: column `pivot` times 1 / weights_pivot, and every
/// other column j less weights_j / weights_pivot times column `pivot`. The matrix itself stays.
ColumnSums count_after_swap(const double* matrix, int rows, int columns, int pivot, const double* weights);

/// Counts the matrix as it is.
ColumnSums count(const double* matrix, int rows, int columns);

}  // namespace zonal::search
