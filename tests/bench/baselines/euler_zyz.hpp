#pragma once

#include <vector>

#include "bench/baselines/z_turn.hpp"

namespace zonal::baselines {

/// The classical Euler form: three angles, a sine and a cosine for each multiple m of each, and
/// Ry(beta) = Rx(-90) Rz(beta) Rx(90) with dense constant matrices.
/// T is float or double. Nothing is allocated after construction.
template <class T>
class EulerZyz {
  public:
    explicit EulerZyz(int order);

    /// R : row-major, orthonormal, determinant +1. f, out: order^2 values, index l(l+1)+m; out may be f.
    void rotate(const T* R, const T* f, T* out);

  private:
    int order_;
    std::vector<T> quarter_turn_;
    ZTurn<T> alpha_, beta_, gamma_;
    std::vector<T> band_, turned_;
};

}  // namespace zonal::baselines
