#pragma once

#include <vector>

#include "bench/baselines/z_turn.hpp"

namespace zonal::baselines {

/// Rz(alpha) Rx(-90) Rz(beta) Rx(90) Rz(gamma) with the zeros of Rx(+-90) left out (three quarters of it),
/// the angles by atan2 and their multiples by the addition theorem: what careful scalar code in use does. T
/// is float or double. Nothing is allocated after construction.
template <class T>
class Zxzxz {
  public:
    explicit Zxzxz(int order);

    /// R : row-major, orthonormal, determinant +1. f, out: order^2 values, index l(l+1)+m; out may be f.
    void rotate(const T* R, const T* f, T* out);

  private:
    /// The nonzeros of a row: every other column from `first` on.
    struct Row {
        int first;
        int count;
    };

    const T* apply(int l, const T* values, const T* in, T* out) const;

    int order_;
    std::vector<Row> rows_;                ///< band l at l^2; the same for both turns
    std::vector<T> forwards_, backwards_;  ///< nonzeros of Rx(90) and Rx(-90), row by row
    ZTurn<T> alpha_, beta_, gamma_;
    std::vector<T> band_, turned_;
};

}  // namespace zonal::baselines
