#pragma once

#include <vector>

namespace zonal::baselines {

/// Index of the first value of band l among dense blocks: the sum of (2k+1)^2 over k < l.
constexpr int block_offset(int l) { return l * (4 * l * l - 1) / 3; }

/// The recursion of Ivanic and Ruedenberg, the most used way to rotate real SH of any order.
/// T is float, double or long double. Nothing is allocated after construction.
template <class T>
class IvanicRuedenberg {
  public:
    /// Tables for all bands l < order; order at least 1.
    explicit IvanicRuedenberg(int order);

    /// dense : for l = 0 ... order-1 a row-major (2l+1)^2 block, block_offset(order) values.
    /// R     : row-major, on column vectors, orthonormal; the function turns, f'(w) = f(R^T w); mirrors too.
    void blocks(const T* R, T* dense) const;

    /// Builds the blocks in room of its own and applies them; out may be f.
    void rotate(const T* R, const T* f, T* out);

  private:
    /// One of the at most five rows that make a row of a band: coefficient times P_axis(row, .).
    struct Term {
        int axis;  ///< row of the band-1 block: -1, 0, 1
        int row;   ///< row of the block of band l - 1
        T coefficient;
    };
    struct Row {
        int first_term;
        int terms;
    };

    void add_rows(int l);
    void next_block(int l, const T* band_1, const T* previous, T* block) const;

    int order_;
    std::vector<Term> terms_;
    std::vector<Row> rows_;         ///< band l at l^2
    std::vector<T> column_scales_;  ///< band l at l^2
    std::vector<T> dense_;
    std::vector<T> band_;
};

}  // namespace zonal::baselines
