#pragma once

#include <variant>
#include <vector>

#include "exact/real.hpp"

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

/// x -> matrix x.
struct Product {
    Matrix<Real> matrix;
};

using BlockStep = std::variant<Shear, Reflection, Product>;

/// An orthogonal matrix as steps in place, done from first to last, and a signed permutation at the end:
/// y_i = signs[i] x_{sources[i]}.
struct OrthogonalBlock {
    int size = 0;
    std::vector<BlockStep> steps;
    std::vector<int> sources;
    std::vector<int> signs;
};

/// Instructions of the steps, after fusing.
int instructions(const OrthogonalBlock& block);

/// The cheapest known factorization of an orthogonal n x n matrix:
///   1 x 1               nothing
///   2 x 2               lifting, 3 shears of one term: Daubechies and Sweldens 1998, section 8
///   symmetric           a reflection of the smaller of its two eigenspaces, of dimension r: 2nr - r^2
///   3 x 3 … 4 x 4       n+1 shears of n-1 terms, searched over orders, signs and permutations for the
///   smallest
///                       largest factor: n^2 - 1; Hao and Shi 2001, "Matrix factorizations for reversible
///                       integer mapping"
///   larger              the product, n^2
/// No factor of a shear is larger than 1.
OrthogonalBlock factorize_orthogonal(const Matrix<Real>& matrix);

/// The matrix that the steps make.
Matrix<Real> multiplied_out(const OrthogonalBlock& block);

}  // namespace zonal::exact
