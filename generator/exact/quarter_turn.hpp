#pragma once

#include <vector>

#include "exact/matrix.hpp"

namespace zonal::exact {

/// A block of a quarter turn: which z-polar coefficients (`rows`, orders m) are made of which y-polar ones
/// (`columns`), and the orthogonal matrix between them.
struct QuarterTurnBlock {
    std::vector<int> rows;
    std::vector<int> columns;
    Matrix<Real> matrix;
};

/// X_l = D_l(Q) with Q = Rx(-90°), which turns z into y: column l+m holds the z-polar coefficients of y_l^m
/// with y as its polar axis. So D_l(Ry(β)) = X_l D_l(Rz(β)) X_lᵀ. Entries below `kZeroThreshold` are exact
/// zeros; the square of every entry is a multiple of 4^(1-l).
Matrix<Real> quarter_turn(int l);

/// The (at most four) blocks X_l falls into, one for every class of columns: m > 0 odd, m < 0 odd, m >= 0
/// even, m < 0 even, in this order; rows and columns ascending by |m|.
std::vector<QuarterTurnBlock> quarter_turn_blocks(int l);

}  // namespace zonal::exact
