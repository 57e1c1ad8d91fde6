#pragma once

#include <span>
#include <type_traits>
#include <vector>

#include "exact/matrix.hpp"

namespace zonal::exact {

/// Values y_l^{-l} … y_l^l (2l+1 of them, index l + m) at a unit direction, `S` double or `Real`: real,
/// orthonormal, no Condon-Shortley sign, z polar. Accurate to a few units in the last place of `S` times l.
/// Source: Nowrouzezahrai et al., eq. 1, with sin^m(theta) taken into the powers of x + iy, so that there is
/// no angle and no pole.
template <class S>
Vector<S> evaluate_band(int l, const Direction<S>& direction);

/// Y_l: row d holds the band's values at direction d.
template <class S>
Matrix<S> band_matrix(int l, std::type_identity_t<std::span<const Direction<S>>> directions);

/// The directions that band l uses of those that bands share: the first 2l+1.
template <class S>
std::span<const Direction<S>> lobes_of_band(int l, const std::vector<Direction<S>>& directions) {
    return std::span(directions).first(2 * l + 1);
}

}  // namespace zonal::exact
