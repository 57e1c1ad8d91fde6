// The inner loops of the search, nine tenths of its time: Highway compiles them for several instruction sets
// and picks one when the program runs. Element i of a column always falls to slot i mod 8, slots are added in
// one order, and nothing is fused (-ffp-contract=off), so a search finds the same lobes on every processor.

#include "search/column_sums.hpp"

#include "search/score.hpp"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "search/column_sums.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace zonal::search::HWY_NAMESPACE {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using Tag = hn::CappedTag<double, kPackedRows>;
using Lanes = hn::Vec<Tag>;
constexpr int kLanes = static_cast<int>(hn::MaxLanes(Tag()));
constexpr int kParts = kPackedRows / kLanes;

/// Eight running sums.
class Slots {
  public:
    HWY_INLINE Slots() {
        for (Lanes& part : parts_) part = hn::Zero(Tag());
    }
    HWY_INLINE void add(int part, Lanes values) { parts_[part] = hn::Add(parts_[part], values); }
    HWY_INLINE double sum() const {
        HWY_ALIGN double s[kPackedRows];
        for (int part = 0; part < kParts; ++part) hn::Store(parts_[part], Tag(), s + part * kLanes);
        return ((s[0] + s[1]) + (s[2] + s[3])) + ((s[4] + s[5]) + (s[6] + s[7]));
    }

  private:
    Lanes parts_[kParts];
};

void multiply_columns(const double* matrix, int rows, int columns, const double* row, double* weights) {
    const Tag d;
    for (int j = 0; j < columns; ++j) {
        Slots total;
        for (int i = 0; i < rows; i += kPackedRows)
            for (int part = 0; part < kParts; ++part) {
                const int k = i + part * kLanes;
                total.add(part, hn::Mul(hn::LoadU(d, matrix + j * rows + k), hn::LoadU(d, row + k)));
            }
        weights[j] = total.sum();
    }
}

ColumnSums count_after_swap(const double* matrix, int rows, int columns, int pivot, const double* weights) {
    const Tag d;
    const double inverse = 1 / weights[pivot];
    const Lanes tiny = hn::Set(d, kZeroInDouble);
    std::size_t nonzeros = 0;
    Slots squares;
    for (int j = 0; j < columns; ++j) {
        const bool is_pivot = j == pivot;
        const Lanes scale = hn::Set(d, is_pivot ? inverse : 1.0);
        const Lanes factor = hn::Set(d, is_pivot ? 0.0 : weights[j] * inverse);
        for (int i = 0; i < rows; i += kPackedRows)
            for (int part = 0; part < kParts; ++part) {
                const int k = i + part * kLanes;
                const Lanes kept = hn::Mul(hn::LoadU(d, matrix + j * rows + k), scale);
                const Lanes taken = hn::Mul(hn::LoadU(d, matrix + pivot * rows + k), factor);
                const Lanes value = hn::Sub(kept, taken);
                nonzeros += hn::CountTrue(d, hn::Ge(hn::Abs(value), tiny));
                squares.add(part, hn::Mul(value, value));
            }
    }
    return {static_cast<int>(nonzeros), squares.sum()};
}

}  // namespace
}  // namespace zonal::search::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace zonal::search {

HWY_EXPORT(multiply_columns);
HWY_EXPORT(count_after_swap);

void multiply_columns(const double* matrix, int rows, int columns, const double* row, double* weights) {
    HWY_DYNAMIC_DISPATCH(multiply_columns)(matrix, rows, columns, row, weights);
}

ColumnSums count_after_swap(const double* matrix, int rows, int columns, int pivot, const double* weights) {
    return HWY_DYNAMIC_DISPATCH(count_after_swap)(matrix, rows, columns, pivot, weights);
}

ColumnSums count(const double* matrix, int rows, int columns) {
    ColumnSums sums;
    for (int k = 0; k < rows * columns; ++k) {
        sums.nonzeros += !(matrix[k] < kZeroInDouble && matrix[k] > -kZeroInDouble);
        sums.squared_norm += matrix[k] * matrix[k];
    }
    return sums;
}

}  // namespace zonal::search
#endif
