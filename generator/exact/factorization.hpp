#pragma once

#include <vector>

#include "exact/real.hpp"

namespace zonal::exact {

/// One band's exact sparse factorization.
struct BandFactorization {
    int band = 0;
    /// Â_l = Y_l^-1, (2l+1) x (2l+1); row l+m belongs to y_l^m, column d to lobe d. Entries below
    /// `kZeroThreshold` are stored as exact zeros.
    Matrix<Real> a_hat;
    int zeros = 0;
    /// cond_2(Y_l); infinite when Y_l is singular (then `a_hat` is empty).
    double condition = 0;
};

/// Factorizes band `l` with the first 2l+1 of `directions` (unit). Source: Nowrouzezahrai et al., eq. 7.
BandFactorization factorize_band(int l, const std::vector<Direction<Real>>& directions);

}  // namespace zonal::exact
