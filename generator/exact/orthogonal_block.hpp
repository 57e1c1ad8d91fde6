#pragma once

#include <variant>
#include <vector>

#include "exact/matrix.hpp"

namespace zonal::exact {

/// x_target += sum_j factors(j) x_j (factors(target) = 0). Undone by the same with the factors negated.
struct Shear {
    int target = 0;
    Vector<Real> factors;
};

/// x -> x - back (forth x), an involution of rank r: `forth` is r x n and holds an identity in the columns
/// `pivots`; `back` is n x r.
struct Reflection {
    std::vector<int> pivots;
    Matrix<Real> forth;
    Matrix<Real> back;
};

/// x -> matrix x, undone by the transpose.
struct Product {
    Matrix<Real> matrix;
};

using BlockStep = std::variant<Shear, Reflection, Product>;

/// A regular matrix as steps in place, done from first to last, and a signed permutation at the end:
/// y_i = signs[i] x_{sources[i]}.
struct BlockSteps {
    int size = 0;
    std::vector<BlockStep> steps;
    std::vector<int> sources;
    std::vector<int> signs;
};

/// Instructions of the steps, after fusing.
int instructions(const BlockSteps& block);

/// The cheapest known factorization of an orthogonal n x n matrix:
///   1 x 1               nothing
///   symmetric           a reflection of the smaller of its two eigenspaces, of dimension r: 2nr - r^2
///   2 x 2 … 4 x 4       n+1 shears of n-1 terms, searched over orders, signs and permutations for the
///                       smallest largest factor: n^2 - 1; Hao and Shi 2001, "Matrix factorizations for
///                       reversible integer mapping"; for n = 2 lifting: Daubechies and Sweldens 1998
///   larger              the product, n^2
/// No factor of a shear is larger than 1.
BlockSteps factorize_orthogonal(const Matrix<Real>& matrix);

/// The matrix as one step.
BlockSteps as_product(const Matrix<Real>& matrix);

/// Matrices, each with its columns multiplied by `scales`.
struct ScaledBlocks {
    std::vector<Real> scales;
    std::vector<BlockSteps> blocks;
};

/// Factorizes orthogonal n x n matrices X_1, X_2, … whose columns may have other lengths, shared by all:
/// X_k S, S diagonal and positive. In X_k T_k X_kᵀ, where T_k commutes with S, nothing changes. Up to n = 4
/// there is an S with which n shears of n - 1 terms make X S, n - 1 factors fewer than without; for a turn by
/// θ they are tan θ and sin θ cos θ, S = (1/cos θ, cos θ). The cheapest of that for one X_k, while the others
/// take n + 1 shears, and of S = 1.
ScaledBlocks factorize_up_to_scales(const std::vector<Matrix<Real>>& matrices);

/// The matrix that the steps make.
Matrix<Real> multiplied_out(const BlockSteps& block);

}  // namespace zonal::exact
