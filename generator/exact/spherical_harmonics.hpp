#pragma once

#include <boost/math/constants/constants.hpp>
#include <cmath>
#include <span>
#include <type_traits>
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

/// Y_l: row d holds the band's values at direction d.
template <class S>
Matrix<S> band_matrix(int l, std::type_identity_t<std::span<const Direction<S>>> directions) {
    Matrix<S> matrix(directions.size(), 2 * l + 1);
    for (int d = 0; d < matrix.rows(); ++d) matrix.row(d) = evaluate_band<S>(l, directions[d]).transpose();
    return matrix;
}

/// The directions that band l uses of those that bands share: the first 2l+1.
template <class S>
std::span<const Direction<S>> lobes_of_band(int l, const std::vector<Direction<S>>& directions) {
    return std::span(directions).first(2 * l + 1);
}

}  // namespace zonal::exact
