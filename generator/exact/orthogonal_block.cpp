#include "exact/orthogonal_block.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <numeric>
#include <optional>

namespace zonal::exact {

namespace {

/// The search among shears tries n!² 2^n of them.
constexpr int kLargestForShears = 4;

bool is_zero(const Real& value) { return abs(value) < kZeroThreshold; }

/// Visits every signed permutation of n things.
template <class Visit>
void for_each_signed_permutation(int n, Visit visit) {
    std::vector<int> sources(n), signs(n);
    std::iota(sources.begin(), sources.end(), 0);
    do {
        for (int bits = 0; bits < (1 << n); ++bits) {
            for (int i = 0; i < n; ++i) signs[i] = (bits >> i) & 1 ? -1 : 1;
            visit(sources, signs);
        }
    } while (std::next_permutation(sources.begin(), sources.end()));
}

/// The matrix whose rows, permuted and signed, are those of `matrix`: what is left for the steps to do.
template <class S>
Matrix<S> before_signed_permutation(const Matrix<S>& matrix, const std::vector<int>& sources,
                                    const std::vector<int>& signs) {
    Matrix<S> result(matrix.rows(), matrix.cols());
    for (int i = 0; i < matrix.rows(); ++i) result.row(sources[i]) = signs[i] * matrix.row(i);
    return result;
}

BlockSteps identity_of(int n) {
    BlockSteps block;
    block.size = n;
    block.sources.resize(n);
    std::iota(block.sources.begin(), block.sources.end(), 0);
    block.signs.assign(n, 1);
    return block;
}

template <class Visit>
void for_each_subset(int n, int size, Visit visit) {
    std::vector<bool> is_in(n, false);
    std::fill(is_in.begin(), is_in.begin() + size, true);
    do {
        std::vector<int> subset;
        for (int i = 0; i < n; ++i)
            if (is_in[i]) subset.push_back(i);
        visit(subset);
    } while (std::prev_permutation(is_in.begin(), is_in.end()));
}

/// A symmetric orthogonal matrix is ±(I - 2P), P the projection onto the smaller eigenspace, V its
/// orthonormal basis. With the rows S where V is best conditioned, P = W (V_S V_Sᵀ) Wᵀ, W = V V_S^-1, an
/// identity on S.
BlockSteps by_reflection(const Matrix<Real>& matrix) {
    const int n = static_cast<int>(matrix.rows());
    const Matrix<Real> identity = Matrix<Real>::Identity(n, n);
    const int dimension_of_minus_one = static_cast<int>(round((n - matrix.trace()) / 2));
    const bool is_minus = 2 * dimension_of_minus_one <= n;
    const int rank = is_minus ? dimension_of_minus_one : n - dimension_of_minus_one;
    BlockSteps block = identity_of(n);
    block.signs.assign(n, is_minus ? 1 : -1);
    if (rank == 0) return block;
    const Matrix<Real> projection = (identity - (is_minus ? 1 : -1) * matrix) / 2;

    // The columns S of the projection span its range; P = P_S (P_SS)^-1 P_Sᵀ.
    Real best_volume = 0;
    Reflection reflection;
    for_each_subset(n, rank, [&](const std::vector<int>& pivots) {
        Matrix<Real> core(rank, rank);
        for (int i = 0; i < rank; ++i)
            for (int j = 0; j < rank; ++j) core(i, j) = projection(pivots[i], pivots[j]);
        const Real volume = core.determinant();
        if (volume <= best_volume) return;
        best_volume = volume;
        Matrix<Real> columns(n, rank);
        for (int j = 0; j < rank; ++j) columns.col(j) = projection.col(pivots[j]);
        reflection = {pivots, core.inverse() * columns.transpose(), 2 * columns};
    });
    for (int k = 0; k < rank; ++k)
        for (int j = 0; j < rank; ++j) reflection.forth(k, reflection.pivots[j]) = k == j ? 1 : 0;
    for (Real& entry : reflection.forth.reshaped())
        if (is_zero(entry)) entry = 0;
    for (Real& entry : reflection.back.reshaped())
        if (is_zero(entry)) entry = 0;
    block.steps = {reflection};
    return block;
}

/// Rows `order[0], …, order[n-1], order[0]` of the identity, sheared one after another, to make `matrix` (of
/// determinant 1). After its shear, row order[t] (0 < t) is final, so that the factors of step t solve a
/// linear system of t equations; what the first shear adds is found on the way. Nothing where a system is
/// singular.
template <class S>
std::optional<std::vector<Vector<S>>> shear_factors(const Matrix<S>& matrix, const std::vector<int>& order,
                                                    const S& smallest_pivot) {
    using std::abs;
    const int n = static_cast<int>(matrix.rows());
    // Matrix with rows in the order they become final; row and column 0 belong to the row sheared twice.
    Matrix<S> m(n, n);
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) m(i, j) = matrix(order[i], order[j]);
    Matrix<S> first_row = Matrix<S>::Identity(1, n);  // the row sheared twice, after its first shear
    std::vector<Vector<S>> weights;                   // of (first row, final rows 1 … t-1) at step t
    for (int t = 1; t < n; ++t) {
        // weights * [first_row; m_1 …; m_{t-1}] must agree with m_t in columns 0 … t-1.
        Matrix<S> system(t, t);
        system.row(0) = first_row.leftCols(t);
        for (int i = 1; i < t; ++i) system.row(i) = m.row(i).leftCols(t);
        const Eigen::PartialPivLU<Matrix<S>> lu(system.transpose().eval());
        if (!(abs(lu.determinant()) > smallest_pivot)) return std::nullopt;
        const Vector<S> w = lu.solve(m.row(t).leftCols(t).transpose());
        if (!(abs(w(0)) > smallest_pivot)) return std::nullopt;
        S rest = m(t, t) - 1;
        for (int i = 1; i < t; ++i) rest -= w(i) * m(i, t);
        first_row(0, t) = rest / w(0);
        weights.push_back(w);
    }
    std::vector<Vector<S>> factors(n + 1, Vector<S>::Zero(n));
    for (int j = 1; j < n; ++j) factors[0](order[j]) = first_row(0, j);
    for (int t = 1; t < n; ++t) {
        const Vector<S>& w = weights[t - 1];
        for (int i = 0; i < t; ++i) factors[t](order[i]) = w(i);
        for (int j = t + 1; j < n; ++j) {
            S rest = m(t, j) - w(0) * first_row(0, j);
            for (int i = 1; i < t; ++i) rest -= w(i) * m(i, j);
            factors[t](order[j]) = rest;
        }
    }
    // m_0 = first_row + sum_i factor_i m_i, read off in columns 1 … n-1.
    const Matrix<S> final_rows = m.bottomRightCorner(n - 1, n - 1);
    const Eigen::PartialPivLU<Matrix<S>> lu(final_rows.transpose().eval());
    if (!(abs(lu.determinant()) > smallest_pivot)) return std::nullopt;
    const Vector<S> last =
        lu.solve((m.row(0).rightCols(n - 1) - first_row.rightCols(n - 1)).transpose().eval());
    for (int i = 1; i < n; ++i) factors[n](order[i]) = last(i - 1);
    return factors;
}

template <class S>
S largest_factor(const std::vector<Vector<S>>& factors) {
    S largest = 0;
    for (const Vector<S>& step : factors) largest = std::max<S>(largest, step.cwiseAbs().maxCoeff());
    return largest;
}

/// Where the signed permutation and the order of the rows leave something to choose.
struct ShearChoice {
    std::vector<int> sources, signs, order;
};

template <class Visit>
void for_each_shear_choice(int n, Visit visit) {
    for_each_signed_permutation(n, [&](const auto& sources, const auto& signs) {
        std::vector<int> order(n);
        std::iota(order.begin(), order.end(), 0);
        do {
            visit(ShearChoice{sources, signs, order});
        } while (std::next_permutation(order.begin(), order.end()));
    });
}

template <class S>
std::optional<std::vector<Vector<S>>> shear_factors(const Matrix<S>& matrix, const ShearChoice& choice,
                                                    const S& smallest_pivot) {
    return shear_factors<S>(before_signed_permutation(matrix, choice.sources, choice.signs), choice.order,
                            smallest_pivot);
}

BlockSteps steps_of(const Matrix<Real>& matrix, const ShearChoice& choice) {
    const int n = static_cast<int>(matrix.rows());
    const auto factors = shear_factors<Real>(matrix, choice, kZeroThreshold);
    BlockSteps block = identity_of(n);
    block.sources = choice.sources;
    block.signs = choice.signs;
    for (int t = 0; t <= n; ++t) {
        Vector<Real> snapped = (*factors)[t];
        for (Real& factor : snapped)
            if (is_zero(factor)) factor = 0;
        if (!snapped.isZero(0)) block.steps.push_back(Shear{choice.order[t % n], snapped});
    }
    return block;
}

std::optional<BlockSteps> by_shears(const Matrix<Real>& matrix) {
    const Matrix<double> rough = matrix.cast<double>();
    ShearChoice best;
    double best_largest = 1;
    for_each_shear_choice(static_cast<int>(matrix.rows()), [&](const ShearChoice& choice) {
        const Matrix<double> rotation = before_signed_permutation(rough, choice.sources, choice.signs);
        if (rotation.determinant() < 0) return;
        const auto factors = shear_factors<double>(rotation, choice.order, 1e-6);
        // The first of choices that are equal but for rounding, so that every machine takes the same.
        if (!factors || !(largest_factor(*factors) < best_largest - 1e-9)) return;
        best_largest = largest_factor(*factors);
        best = choice;
    });
    if (best.order.empty()) return std::nullopt;
    return steps_of(matrix, best);
}

/// Scales of the columns with which no row is sheared twice: the first shear is nothing where the minors of
/// the rows and columns order[1] … order[t] are 1 for every t, and the determinant is.
template <class S>
std::vector<S> scales_for(const Matrix<S>& matrix, const ShearChoice& choice) {
    const Matrix<S> rotation = before_signed_permutation(matrix, choice.sources, choice.signs);
    const int n = static_cast<int>(matrix.rows());
    std::vector<S> scales(n);
    S minor_before = 1;
    for (int t = 1; t <= n; ++t) {
        Matrix<S> part(t, t);
        for (int i = 0; i < t; ++i)
            for (int j = 0; j < t; ++j)
                part(i, j) = rotation(choice.order[(i + 1) % n], choice.order[(j + 1) % n]);
        const S minor = part.determinant();
        scales[choice.order[t % n]] = minor_before / minor;
        minor_before = minor;
    }
    return scales;
}

template <class S>
Matrix<S> with_scaled_columns(Matrix<S> matrix, const std::vector<S>& scales) {
    for (int j = 0; j < matrix.cols(); ++j) matrix.col(j) *= scales[j];
    return matrix;
}

/// n shears of n - 1 terms for columns of any length, none shorter than half or longer than twice.
std::optional<ScaledBlocks> by_shears_up_to_scales(const Matrix<Real>& matrix) {
    const Matrix<double> rough = matrix.cast<double>();
    ShearChoice best;
    double best_largest = 1;
    for_each_shear_choice(static_cast<int>(matrix.rows()), [&](const ShearChoice& choice) {
        const std::vector<double> scales = scales_for<double>(rough, choice);
        if (!std::ranges::all_of(scales, [](double scale) { return 0.5 <= scale && scale <= 2; })) return;
        const auto factors = shear_factors<double>(with_scaled_columns(rough, scales), choice, 1e-6);
        if (!factors || !(largest_factor(*factors) < best_largest - 1e-9)) return;
        best_largest = largest_factor(*factors);
        best = choice;
    });
    if (best.order.empty()) return std::nullopt;
    const std::vector<Real> scales = scales_for<Real>(matrix, best);
    return ScaledBlocks{scales, {steps_of(with_scaled_columns(matrix, scales), best)}};
}

int nonzeros(const Matrix<Real>& matrix) { return static_cast<int>((matrix.array() != Real(0)).count()); }

struct StepCost {
    int operator()(const Shear& shear) const { return nonzeros(shear.factors); }
    int operator()(const Reflection& reflection) const {
        return nonzeros(reflection.forth) - static_cast<int>(reflection.pivots.size()) +
               nonzeros(reflection.back);
    }
    int operator()(const Product& product) const { return nonzeros(product.matrix); }
};

struct StepMatrix {
    int size;
    Matrix<Real> operator()(const Shear& shear) const {
        Matrix<Real> matrix = Matrix<Real>::Identity(size, size);
        matrix.row(shear.target) += shear.factors.transpose();
        return matrix;
    }
    Matrix<Real> operator()(const Reflection& reflection) const {
        return Matrix<Real>::Identity(size, size) - reflection.back * reflection.forth;
    }
    Matrix<Real> operator()(const Product& product) const { return product.matrix; }
};

}  // namespace

int instructions(const BlockSteps& block) {
    int count = 0;
    for (const BlockStep& step : block.steps) count += std::visit(StepCost{}, step);
    return count;
}

BlockSteps factorize_orthogonal(const Matrix<Real>& matrix) {
    const int n = static_cast<int>(matrix.rows());
    if (n == 1) {
        BlockSteps block = identity_of(1);
        block.signs = {matrix(0, 0) < 0 ? -1 : 1};
        return block;
    }
    if (is_zero((matrix - matrix.transpose()).norm())) return by_reflection(matrix);
    if (n <= kLargestForShears)
        if (const auto block = by_shears(matrix)) return *block;
    return as_product(matrix);
}

BlockSteps as_product(const Matrix<Real>& matrix) {
    BlockSteps block = identity_of(static_cast<int>(matrix.rows()));
    block.steps = {Product{matrix}};
    return block;
}

ScaledBlocks factorize_up_to_scales(const std::vector<Matrix<Real>>& matrices) {
    const int n = static_cast<int>(matrices.front().cols());
    ScaledBlocks best;
    best.scales.assign(n, 1);
    for (const Matrix<Real>& matrix : matrices) best.blocks.push_back(factorize_orthogonal(matrix));
    if (n == 1 || n > kLargestForShears) return best;
    const auto total = [](const ScaledBlocks& some) {
        int sum = 0;
        for (const BlockSteps& block : some.blocks) sum += instructions(block);
        return sum;
    };
    // The scales serve one matrix; the others take the most shears.
    for (std::size_t served = 0; served < matrices.size(); ++served) {
        const auto scaled = by_shears_up_to_scales(matrices[served]);
        if (!scaled) continue;
        ScaledBlocks some{scaled->scales, {}};
        for (std::size_t k = 0; k < matrices.size(); ++k) {
            const auto block = k == served ? std::optional(scaled->blocks[0])
                                           : by_shears(with_scaled_columns(matrices[k], some.scales));
            if (block) some.blocks.push_back(*block);
        }
        if (some.blocks.size() == matrices.size() && total(some) < total(best)) best = some;
    }
    return best;
}

Matrix<Real> multiplied_out(const BlockSteps& block) {
    Matrix<Real> result = Matrix<Real>::Identity(block.size, block.size);
    for (const BlockStep& step : block.steps) result = std::visit(StepMatrix{block.size}, step) * result;
    Matrix<Real> permuted(block.size, block.size);
    for (int i = 0; i < block.size; ++i) permuted.row(i) = block.signs[i] * result.row(block.sources[i]);
    return permuted;
}

}  // namespace zonal::exact
