#include "bounds/derived.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <vector>

namespace zonal {

namespace {

using graph::Id;
using graph::Kernel;
using graph::Kind;
using graph::Node;
using graph::Op;

/// A value's size and error: of a scalar one number each, of a signal one for each element of f.
struct Analysed {
    Eigen::ArrayXd size, error;

    bool is_scalar() const { return size.size() == 1; }
};

Analysed product(const Analysed& a, const Analysed& b) {
    const Analysed& scalar = a.is_scalar() ? a : b;
    const Analysed& other = a.is_scalar() ? b : a;
    return {scalar.size(0) * other.size, scalar.error(0) * other.size + scalar.size(0) * other.error};
}

Analysed sum(const Analysed& a, const Analysed& b) { return {a.size + b.size, a.error + b.error}; }

Analysed rounded(Analysed value) {
    value.error += value.size;
    return value;
}

bool is_power_of_two(const Node& node) {
    int exponent = 0;
    return node.op == Op::constant &&
           std::abs(std::frexp(static_cast<double>(node.value), &exponent)) == 0.5 &&
           graph::Number(static_cast<double>(node.value)) == node.value;
}

Analysed of_constant(const graph::Number& value) {
    const auto nearest = static_cast<float>(static_cast<double>(value));
    const double size = std::abs(static_cast<double>(value));
    return {Eigen::ArrayXd::Constant(1, size),
            Eigen::ArrayXd::Constant(1, graph::Number(nearest) == value ? 0 : size)};
}

class Analysis {
  public:
    Analysis(const Kernel& kernel, bool is_fused) : kernel_(kernel), is_fused_(is_fused) {
        for (Id id = 0; id < kernel.graph.size(); ++id) {
            Analysed value = analyse(kernel.graph[id]);
            value.size = value.size.min(kernel.graph[id].most);
            values_.push_back(std::move(value));
        }
    }

    double bound() const {
        Eigen::MatrixXd errors(kernel_.stores.size(), kernel_.inputs[1].size);
        for (std::size_t k = 0; k < kernel_.stores.size(); ++k)
            errors.row(static_cast<Eigen::Index>(k)) = values_[kernel_.stores[k].value].error.matrix();
        return std::sqrt(errors.rowwise().sum().maxCoeff() * errors.colwise().sum().maxCoeff());
    }

  private:
    Analysed multiplied(Id a, Id b) const {
        const Analysed exact = product(values_[a], values_[b]);
        const bool is_exact = is_power_of_two(kernel_.graph[a]) || is_power_of_two(kernel_.graph[b]);
        return is_exact ? exact : rounded(exact);
    }

    Analysed analyse(const Node& node) const {
        const auto operand = [&](int k) -> const Analysed& { return values_[node.operands[k]]; };
        switch (node.op) {
            case Op::constant:
                return of_constant(node.value);
            case Op::input:
                return of_input(node);
            case Op::negate:
                return operand(0);
            case Op::add:
            case Op::subtract:
                return rounded(sum(operand(0), operand(1)));
            case Op::multiply:
                return multiplied(node.operands[0], node.operands[1]);
            case Op::fused:
                return rounded(sum(is_fused_ ? product(operand(0), operand(1))
                                             : multiplied(node.operands[0], node.operands[1]),
                                   operand(2)));
            default:
                throw std::logic_error("an operation without an analysis");
        }
    }

    Analysed of_input(const Node& node) const {
        if (node.kind == Kind::rotation) return {Eigen::ArrayXd::Ones(1), Eigen::ArrayXd::Zero(1)};
        const int elements = kernel_.inputs[1].size;
        Analysed value{Eigen::ArrayXd::Zero(elements), Eigen::ArrayXd::Zero(elements)};
        value.size(node.index) = 1;
        return value;
    }

    const Kernel& kernel_;
    bool is_fused_;
    std::vector<Analysed> values_;
};

bool is_analysed(const Kernel& kernel) {
    if (kernel.inputs.size() != 2 || kernel.inputs[0].name != "R" || kernel.output.kind != Kind::signal)
        return false;
    for (Id id = 0; id < kernel.graph.size(); ++id) {
        const Op op = kernel.graph[id].op;
        if (op == Op::divide || op == Op::square_root || op == Op::copy_sign) return false;
    }
    return true;
}

}  // namespace

std::optional<DerivedBound> derived_bound(const Kernel& kernel) {
    if (!is_analysed(kernel)) return std::nullopt;
    return DerivedBound{Analysis(kernel, true).bound(), Analysis(kernel, false).bound()};
}

}  // namespace zonal
