#pragma once

#include <cmath>
#include <type_traits>
#include <vector>

#include "graph/schedule.hpp"

namespace zonal::graph {

/// Products and sums rounded once, quotients and roots to the nearest.
struct Fused {
    template <class T>
    static T fma(T a, T b, T c) {
        return std::fma(a, b, c);
    }
    template <class T>
    static T divide(T a, T b) {
        return a / b;
    }
    template <class T>
    static T square_root(T a) {
        return std::sqrt(a);
    }
};

/// Runs a kernel in floating-point type T as printed code would: the same operations on constants rounded to
/// T, by an arithmetic. `inputs` holds one pointer an input array; the output must not be one of them.
template <class T, class Arithmetic = Fused>
class Evaluator {
  public:
    explicit Evaluator(const Kernel& kernel) : kernel_(kernel), values_(kernel.graph.size()) {
        for (Id id = 0; id < kernel.graph.size(); ++id)
            if (kernel.graph[id].op == Op::constant)
                values_[id] = static_cast<T>(static_cast<double>(kernel.graph[id].value));
    }

    void operator()(const std::vector<const T*>& inputs, T* output) {
        for (Id id = 0; id < kernel_.graph.size(); ++id) values_[id] = compute(id, inputs);
        for (const Store& store : kernel_.stores) output[store.index] = values_[store.value];
    }

  private:
    T compute(Id id, const std::vector<const T*>& inputs) const {
        const Node& node = kernel_.graph[id];
        const auto operand = [&](int k) { return values_[node.operands[k]]; };
        switch (node.op) {
            case Op::constant:
                return values_[id];
            case Op::input:
                return inputs[node.array][node.index];
            case Op::negate:
                return -operand(0);
            case Op::add:
                return operand(0) + operand(1);
            case Op::subtract:
                return operand(0) - operand(1);
            case Op::multiply:
                return operand(0) * operand(1);
            case Op::fused:
                return Arithmetic::fma(node.negated_product ? -operand(0) : operand(0), operand(1),
                                       node.negated_addend ? -operand(2) : operand(2));
            case Op::divide:
                return Arithmetic::divide(operand(0), operand(1));
            case Op::square_root:
                return Arithmetic::square_root(operand(0));
            case Op::copy_sign:
                return std::copysign(operand(std::is_same_v<T, float> ? 1 : 0), operand(2));
        }
        return T(0);
    }

    const Kernel& kernel_;
    std::vector<T> values_;
};

}  // namespace zonal::graph
