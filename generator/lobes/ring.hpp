#pragma once

#include <vector>

#include "exact/matrix.hpp"
#include "lobes/factorization.hpp"

namespace zonal {

/// Equally spaced directions at one polar angle. An odd number of them, at least 2l+1, sees every function of
/// band l, and the functions stay orthogonal on the ring: so a band's factorization is Yᵀ with scaled rows.
struct Ring {
    int count = 0;
    exact::Real theta;  ///< radians

    std::vector<exact::Direction<exact::Real>> directions() const;

    /// Â_l, (2l+1) x count, with Yᵀ Âᵀ = 1; its `zeros`, and cond_2(Y_l).
    BandFactorization factorize(int l) const;
};

/// The ring of 2*order-1 lobes whose worst condition over the bands is least, theta to a hundredth of a
/// radian.
Ring best_ring(int order);

}  // namespace zonal
