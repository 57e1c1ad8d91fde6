// The dense matrix of every band from the one before: D_l is what R ⊗ D_{l-1} does to the harmonics of degree
// l.
//
// No angle, no division by a value, no pole; D_1 is R itself, and a mirror is as good as a rotation.
// Source: Ivanic and Ruedenberg 1996, "Rotation Matrices for Real Spherical Harmonics", eqs. 6.3, 7.1, 8.1
// with the erratum of 1998.
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

class Recursion {
  public:
    Recursion(graph::Graph& graph, const Matrix3& rows, int l, const std::vector<Value>& previous)
        : graph_(graph), rows_(rows), l_(l), previous_(previous) {}

    Value entry(int m, int n) {
        const int k = std::abs(m);
        const Number denominator =
            std::abs(n) < l_ ? Number((l_ + n) * (l_ - n)) : Number(2 * l_ * (2 * l_ - 1));
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
    void add(const Number& factor, int i, int m, int n) {
        if (factor == 0) return;  // what it would multiply need not exist
        Value product;
        if (n == l_) {
            const Value second = r(i, -1) * p(m, 1 - l_);
            product = r(i, 1) * p(m, l_ - 1) - second;
        } else if (n == -l_) {
            const Value second = r(i, -1) * p(m, l_ - 1);
            product = r(i, 1) * p(m, 1 - l_) + second;
        } else {
            product = r(i, 0) * p(m, n);
        }
        terms_.push_back({factor, product});
    }

    graph::Graph& graph_;
    const Matrix3& rows_;
    int l_;
    const std::vector<Value>& previous_;
    std::vector<graph::Term> terms_;
};

}  // namespace

std::vector<std::vector<Value>> dense_blocks(graph::Kernel& kernel, const Matrix3& rows, int order) {
    graph::Graph& graph = kernel.graph;
    std::vector<std::vector<Value>> blocks{{Value{&graph, graph.constant(1)}}};
    for (int l = 1; l < order; ++l) {
        std::vector<Value> block;
        Recursion recursion(graph, rows, l, blocks.back());
        for (int m = -l; m <= l; ++m) {
            for (int n = -l; n <= l; ++n) {
                graph.set_scope(fmt::format("d{}", l));
                block.push_back(l == 1 ? band_1(rows, m, n) : recursion.entry(m, n));
                graph.set_name(block.back().id, fmt::format("d{}_{}_{}", l, l + m, l + n));
            }
        }
        blocks.push_back(std::move(block));
    }
    return blocks;
}

}  // namespace zonal::kernels
