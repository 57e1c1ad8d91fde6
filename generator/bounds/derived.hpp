#pragma once

#include <optional>

#include "graph/kernel.hpp"

namespace zonal {

/// Bounds of |computed - exact| / |f| in units of rounding (2^-24 in float, 2^-53 in double), to first order
/// in them, for orthonormal R.
struct DerivedBound {
    double fused = 0;  ///< with fused instructions
    double apart = 0;  ///< a product and a sum for each
};

/// Analyses the roundings of a kernel of R and f. None for kernels with a quotient or a root, of other
/// inputs, or without a signal.
///
/// One pass over the graph. With |R_ij| <= 1, for a rotation scalar s: |s| <= M and |computed s - s| <= E u;
/// for a signal value v = sum_j c_j f_j: |c_j| <= m_j and |computed v - v| <= u sum_j e_j |f_j|. Every
/// operation adds one rounding of its result, but for changes of sign and products with powers of two; a
/// constant that no float holds is off by one. Of the result |error| <= u E |f| by components, E >= 0, and
/// so in norm at most u |E|_2 |f| <= u sqrt(|E|_1 |E|_inf) |f|. What a builder knows of a value's size
/// (Node::most, such as 1 for entries of orthogonal matrices) takes the place of M.
std::optional<DerivedBound> derived_bound(const graph::Kernel& kernel);

}  // namespace zonal
