#pragma once

#include <vector>

#include "exact/matrix.hpp"

namespace zonal::exact {

/// Coefficients c_j of z^(l-m-2j), j = 0, 1, …, of the m-th derivative of the Legendre polynomial P_l,
/// divided by its leading coefficient, so c_0 = 1. Preconditions: 0 <= m <= l.
std::vector<Real> monic_legendre_derivative(int l, int m);

/// The factor k with y_l^m = k * q(z) * {C_m or S_m}(x, y), where q is `monic_legendre_derivative(l, |m|)`
/// and C_m + i S_m = (x + i y)^|m|. Source: Nowrouzezahrai et al., eq. 1.
Real basis_scale(int l, int m);

/// Zeros in (0, 1), ascending, of the associated Legendre function P_l^m as a function of z = cos(theta).
/// (z = 0 is a zero as well when l - m is odd, and z = 1 when m > 0.) They start from
/// the positive eigenvalues of the Jacobi matrix of the Gegenbauer polynomials C^(m+1/2), l - m by l - m, and
/// are polished by Newton's method at 50 digits. Preconditions: 0 <= m <= l.
std::vector<Real> legendre_zeros(int l, int m);

}  // namespace zonal::exact
