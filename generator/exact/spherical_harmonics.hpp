#pragma once

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <vector>

#include "exact/real.hpp"

namespace zonal::exact {

/// Values y_l^{-l} … y_l^l (2l+1 of them, index l + m) at a unit direction, for any real scalar `S`: real,
/// orthonormal, no Condon-Shortley sign, z polar. Accurate to a few units in the last place of `S` times l.
/// Source: Nowrouzezahrai et al., eq. 1, with sin^m(theta) taken into the powers of x + iy, so that there is
/// no angle and no pole.
template <class S>
Vector<S> evaluate_band(int l, const Direction<S>& direction) {
    using std::sqrt;
    const S x = direction(0), y = direction(1), z = direction(2);
    Vector<S> values(2 * l + 1);
    S cosine{1}, sine{0};  // C_m and S_m
    S sectoral{1};         // d^m P_m / dz^m = (2m-1)!!
    S factorial_ratio{1};  // (l+m)! / (l-m)!
    const S band_norm = S(2 * l + 1) / (4 * boost::math::constants::pi<S>());
    for (int m = 0; m <= l; ++m) {
        S previous{0}, legendre = sectoral;  // d^m P_k / dz^m for k = m - 1, m
        for (int k = m + 1; k <= l; ++k) {
            const S next = (S(2 * k - 1) * z * legendre - S(k + m - 1) * previous) / S(k - m);
            previous = legendre;
            legendre = next;
        }
        const S norm = sqrt(band_norm * S(m == 0 ? 1 : 2) / factorial_ratio);
        values(l + m) = norm * legendre * cosine;
        if (m > 0) values(l - m) = norm * legendre * sine;

        const S next_cosine = x * cosine - y * sine;
        sine = x * sine + y * cosine;
        cosine = next_cosine;
        sectoral *= S(2 * m + 1);
        factorial_ratio *= S((l + m + 1) * (l - m));  // never used again at m = l, where it becomes 0
    }
    return values;
}

/// Y_l: row d holds the band's values at lobe d, for the first 2l+1 of `directions`.
template <class S>
Matrix<S> band_matrix(int l, const std::vector<Direction<S>>& directions) {
    const int size = 2 * l + 1;
    Matrix<S> matrix(size, size);
    for (int d = 0; d < size; ++d) matrix.row(d) = evaluate_band<S>(l, directions[d]).transpose();
    return matrix;
}

}  // namespace zonal::exact
