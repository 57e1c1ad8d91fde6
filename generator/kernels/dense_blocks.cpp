// The dense matrix of every band from the one before: D_l is what R ⊗ D_{l-1} does to the harmonics of degree
// l. An entry (m, n) is ⟨l m| R ⊗ D_{l-1} |x⟩ / ⟨l n|x⟩ for any x, a product of a harmonic of degree 1 and
// one of degree l - 1 or a sum of two, whose part of degree l is y_l^n alone.
//
// No angle, no division by a value, no pole; D_1 is R itself, and a mirror is as good as a rotation.
// Source: Ivanic and Ruedenberg 1996, "Rotation Matrices for Real Spherical Harmonics", eqs. 6.3, 7.1, 8.1
// with the erratum of 1998; they take x = y_1^0 y_{l-1}^n for all columns but |n| = l. The part of degree l
// then fades towards them, and what rounding did to D_{l-1} is divided by it, band after band.
#include "kernels/dense_blocks.hpp"

#include <fmt/format.h>

#include "graph/sum.hpp"

namespace zonal::kernels {

namespace {

using graph::Number;
using graph::Value;

/// R of band 1 by orders -1, 0, 1, that is y, z, x.
Value band_1(const Matrix3& rows, int i, int j) {
    constexpr int kAxis[] = {1, 2, 0};
    return rows[kAxis[i + 1]][kAxis[j + 1]];
}

/// Columns with |n| above this many tenths of l are outer ones. What is random in D_{l-1} does not grow where
/// x has at least a third in degree l, as much as a random product has: y_1^0 y_{l-1}^n up to |n| = 0.58 l,
/// y_1^{±1} y_{l-1}^{n∓1} from 0.15 l on, for twice the products. A little later costs less: at order 20
/// errors in float are a third of the published recursion's.
static_assert(kInnerTenths >= 5, "outer columns have |n| >= 2: y_{l-1}^0 is normalised in another way");

bool is_outer(int l, int n) { return 10 * std::abs(n) > kInnerTenths * l; }

class Recursion {
  public:
    Recursion(graph::Graph& graph, const Matrix3& rows, int l, const std::vector<Value>& previous)
        : graph_(graph), rows_(rows), l_(l), previous_(previous) {}

    Value entry(int m, int n) {
        const int k = std::abs(m), c = std::abs(n);
        const Number denominator = is_outer(l_, n) ? (l_ + c) * (l_ + c - 1) : (l_ + n) * (l_ - n);
        terms_.clear();
        const Number u = sqrt(Number((l_ + m) * (l_ - m)) / denominator);
        const Number v = sqrt(Number((k + l_ - 1) * (k + l_)) / denominator) / 2;
        const Number w = -sqrt(Number((l_ - k - 1) * (l_ - k)) / denominator) / 2;
        add(u, 0, m, n);
        const Number root_2 = sqrt(Number(2));
        if (m == 0) {
            add(-root_2 * v, 1, 1, n);
            add(-root_2 * v, -1, -1, n);
        } else if (m > 0) {
            add(m == 1 ? Number(root_2 * v) : v, 1, m - 1, n);
            if (m > 1) add(-v, -1, 1 - m, n);
        } else {
            if (m < -1) add(v, 1, m + 1, n);
            add(m == -1 ? Number(root_2 * v) : v, -1, -m - 1, n);
        }
        if (m > 0) {
            add(w, 1, m + 1, n);
            add(w, -1, -m - 1, n);
        } else if (m < 0) {
            add(w, 1, m - 1, n);
            add(-w, -1, 1 - m, n);
        }
        return linear_combination(graph_, terms_);
    }

  private:
    Value r(int i, int j) const { return band_1(rows_, i, j); }
    Value p(int m, int n) const {
        const int size = 2 * l_ - 1;
        return previous_[(m + l_ - 1) * size + n + l_ - 1];
    }
    /// Adds factor * ((row i of R) ⊗ (row m of D_{l-1})) x: x = y_1^0 y_{l-1}^n for inner columns,
    /// y_1^1 y_{l-1}^{n-1} - y_1^{-1} y_{l-1}^{1-n} or its like with n < 0 for outer ones.
    void add(const Number& factor, int i, int m, int n) {
        if (factor == 0) return;  // what it would multiply need not exist
        Value product;
        if (!is_outer(l_, n)) {
            product = r(i, 0) * p(m, n);
        } else if (n > 0) {
            const Value second = r(i, -1) * p(m, 1 - n);
            product = r(i, 1) * p(m, n - 1) - second;
        } else {
            const Value second = r(i, -1) * p(m, -n - 1);
            product = r(i, 1) * p(m, n + 1) + second;
        }
        terms_.push_back({factor, product});
    }

    graph::Graph& graph_;
    const Matrix3& rows_;
    int l_;
    const std::vector<Value>& previous_;
    std::vector<graph::Term> terms_;
};

Matrix3 transposed(const Matrix3& rows) {
    Matrix3 columns;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) columns[i][j] = rows[j][i];
    return columns;
}

std::vector<Value> transposed(const std::vector<Value>& block, int size) {
    std::vector<Value> columns;
    for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) columns.push_back(block[j * size + i]);
    return columns;
}

}  // namespace

// The inverse has the transposed matrix. Entries of outer columns whose row is nearer to 0 are taken from
// there; others are not: with noise in R, entries by rows and by columns in turn lose more than
// (N-1)/2 |R R^T - I|_F.
std::vector<std::vector<Value>> dense_blocks(graph::Kernel& kernel, const Matrix3& rows, int order) {
    graph::Graph& graph = kernel.graph;
    const Matrix3 columns = transposed(rows);
    std::vector<std::vector<Value>> blocks{{Value{&graph, graph.constant(1)}}};
    for (int l = 1; l < order; ++l) {
        const std::vector<Value> previous_of_inverse = transposed(blocks.back(), 2 * l - 1);
        Recursion recursion(graph, rows, l, blocks.back());
        Recursion inverse(graph, columns, l, previous_of_inverse);
        const auto entry = [&](int m, int n) {
            if (l == 1) return band_1(rows, m, n);
            return is_outer(l, n) && std::abs(m) < std::abs(n) ? inverse.entry(n, m) : recursion.entry(m, n);
        };
        std::vector<Value> block;
        for (int m = -l; m <= l; ++m) {
            for (int n = -l; n <= l; ++n) {
                graph.set_scope(fmt::format("d{}", l));
                block.push_back(entry(m, n));
                graph.set_name(block.back().id, fmt::format("d{}_{}_{}", l, l + m, l + n));
                graph.set_most(block.back().id, 1);  // an entry of an orthogonal matrix
            }
        }
        blocks.push_back(std::move(block));
    }
    return blocks;
}

}  // namespace zonal::kernels
