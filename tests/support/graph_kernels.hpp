#pragma once

#include <map>
#include <memory>

#include "graph/evaluate.hpp"
#include "graph/passes.hpp"
#include "support/accuracy.hpp"

namespace zonal {

/// A rotating kernel run from its graph, without a compiler, in T: the operations of the printed code. What
/// depends on the rotation only is computed when the rotation changes.
template <class T, class Arithmetic = graph::Fused>
class GraphRotation {
  public:
    explicit GraphRotation(const graph::Kernel& kernel)
        : halves_(graph::split_by_kind(kernel)),
          prepare_(halves_.prepare),
          apply_(halves_.apply),
          scalars_(halves_.prepare.output.size) {}
    GraphRotation(const GraphRotation&) = delete;

    void operator()(const T* R, const T* f, T* out) {
        if (!std::equal(rotation_.begin(), rotation_.end(), R, R + 9)) {
            rotation_.assign(R, R + 9);
            prepare_({R}, scalars_.data());
        }
        apply_({scalars_.data(), f}, out);
    }

  private:
    graph::Halves halves_;
    graph::Evaluator<T, Arithmetic> prepare_, apply_;
    std::vector<T> rotation_, scalars_;
};

/// Dense blocks and the product with them.
template <class T, class Arithmetic>
class GraphBlocks {
  public:
    GraphBlocks(const graph::Kernel& kernel, int order)
        : kernel_(kernel), blocks_(kernel_), order_(order), dense_(kernel.output.size) {}
    GraphBlocks(const GraphBlocks&) = delete;

    void operator()(const T* R, const T* f, T* out) {
        if (!std::equal(rotation_.begin(), rotation_.end(), R, R + 9)) {
            rotation_.assign(R, R + 9);
            blocks_({R}, dense_.data());
        }
        const T* entry = dense_.data();
        for (int l = 0; l < order_; ++l) {
            for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
                T sum = 0;
                for (int j = l * l; j < (l + 1) * (l + 1); ++j) sum = Arithmetic::fma(*entry++, f[j], sum);
                out[i] = sum;
            }
        }
    }

  private:
    graph::Kernel kernel_;
    graph::Evaluator<T, Arithmetic> blocks_;
    int order_;
    std::vector<T> rotation_, dense_;
};

/// Every kernel of an order that turns a signal and publishes a bound, with the excess it publishes (or 0).
template <class T, class Arithmetic = graph::Fused>
std::vector<accuracy::Contestant<T>> graph_contestants(int order, const std::vector<graph::Kernel>& kernels,
                                                       const std::map<std::string, double>& excess) {
    using Evaluator = graph::Evaluator<T, Arithmetic>;
    std::vector<accuracy::Contestant<T>> contestants;
    for (const graph::Kernel& kernel : kernels) {
        if (!kernel.has_bound) continue;
        accuracy::Contestant<T> contestant;
        contestant.name = kernel.full_name();
        if (excess.contains(contestant.name)) contestant.excess = excess.at(contestant.name);
        if (kernel.name == "apply") {
            // Its rotation scalars are made by `prepare`: the whole kernel is the two in a row.
            const auto prepare = std::make_shared<Evaluator>(*std::find_if(
                kernels.begin(), kernels.end(), [](const auto& k) { return k.name == "prepare"; }));
            const auto apply = std::make_shared<Evaluator>(kernel);
            const auto scalars = std::make_shared<std::vector<T>>(kernel.inputs[0].size);
            contestant.rotate = [=](const T* R, const T* f, T* out) {
                (*prepare)({R}, scalars->data());
                (*apply)({scalars->data(), f}, out);
            };
        } else if (kernel.name == "blocks") {
            const auto run = std::make_shared<GraphBlocks<T, Arithmetic>>(kernel, order);
            contestant.rotate = [run](const T* R, const T* f, T* out) { (*run)(R, f, out); };
        } else {
            const auto run = std::make_shared<GraphRotation<T, Arithmetic>>(kernel);
            contestant.rotate = [run](const T* R, const T* f, T* out) { (*run)(R, f, out); };
        }
        contestants.push_back(kernel.needs_proper_rotation ? accuracy::with_mirrors(order, contestant)
                                                           : contestant);
    }
    return contestants;
}

}  // namespace zonal
