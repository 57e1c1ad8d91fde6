#pragma once

#include <vector>

#include "exact/matrix.hpp"

namespace zonal {

/// One band's exact sparse factorization.
struct BandFactorization {
    int band = 0;
    /// Â_l = Y_l^-1, (2l+1) x (2l+1); row l+m belongs to y_l^m, column d to lobe d. Entries below
    /// `exact::kZeroThreshold` are stored as exact zeros.
    exact::Matrix<exact::Real> a_hat;
    int zeros = 0;
    /// cond_2(Y_l); infinite when Y_l is singular (then `a_hat` is empty).
    double condition = 0;

    int nonzeros() const { return static_cast<int>(a_hat.size()) - zeros; }
};

/// Factorizes band `l` with the first 2l+1 of `directions` (unit). Source: Nowrouzezahrai et al., eq. 7.
BandFactorization factorize_band(int l, const std::vector<exact::Direction<exact::Real>>& directions);

/// How many bands this program has factorized so far: each takes an inverse at 50 digits, so that nobody
/// should do it twice.
int factorized_bands();

}  // namespace zonal
