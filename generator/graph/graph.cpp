#include "graph/graph.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace zonal::graph {

namespace {

Kind joined(Kind a, Kind b) { return std::max(a, b); }

/// Constants whose relative difference is smaller are one that was derived in two ways.
const Number kSameValue{"1e-45"};

}  // namespace

std::size_t Graph::KeyHash::operator()(const Key& key) const {
    std::size_t hash = static_cast<std::size_t>(key.op);
    const auto add = [&](int value) { hash = (hash ^ static_cast<unsigned>(value)) * 0x9e3779b97f4a7c15u; };
    for (const Id operand : key.operands) add(operand);
    add(2 * key.negated_product + key.negated_addend);
    add(key.array);
    add(key.index);
    return hash ^ (hash >> 32);
}

void Graph::reserve(int size) {
    nodes_.reserve(size);
    known_.reserve(size);
}

Id Graph::append(Node node) {
    node.scope = scope_;
    nodes_.push_back(std::move(node));
    return size() - 1;
}

Id Graph::intern(Node node) {
    Key key{node.op, node.operands, node.negated_product, node.negated_addend, node.array, node.index};
    const auto [entry, is_new] = known_.try_emplace(std::move(key), size());
    if (is_new) append(std::move(node));
    return entry->second;
}

Id Graph::constant(const Number& value) {
    const auto key = static_cast<double>(value);
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    const auto last = constants_.upper_bound(std::nextafter(key, kInfinity));
    for (auto near = constants_.lower_bound(std::nextafter(key, -kInfinity)); near != last; ++near)
        if (abs(nodes_[near->second].value - value) <= kSameValue * abs(value)) return near->second;
    Node node;
    node.value = value;
    constants_.emplace(key, size());
    return append(std::move(node));
}

Id Graph::input(Kind kind, int array, int index) {
    Node node;
    node.op = Op::input;
    node.kind = kind;
    node.array = array;
    node.index = index;
    return intern(std::move(node));
}

Id Graph::negate(Id a) {
    if (nodes_[a].op == Op::constant) return constant(-nodes_[a].value);
    if (nodes_[a].op == Op::negate) return nodes_[a].operands[0];
    Node node;
    node.op = Op::negate;
    node.kind = nodes_[a].kind;
    node.operands = {a};
    return intern(std::move(node));
}

Id Graph::add(Id a, Id b) {
    const Node &left = nodes_[a], &right = nodes_[b];  // until a node is made
    if (left.op == Op::constant && right.op == Op::constant) return constant(left.value + right.value);
    if (left.op == Op::constant && left.value == 0) return b;
    if (right.op == Op::constant && right.value == 0) return a;
    if ((left.kind == Kind::signal) != (right.kind == Kind::signal))
        throw std::logic_error("a signal value can only be added to a signal value");
    if (right.op == Op::negate) return subtract(a, right.operands[0]);
    if (left.op == Op::negate) return subtract(b, left.operands[0]);
    Node node;
    node.op = Op::add;
    node.kind = joined(left.kind, right.kind);
    node.operands = {std::min(a, b), std::max(a, b)};
    return intern(std::move(node));
}

Id Graph::subtract(Id a, Id b) {
    const Node &left = nodes_[a], &right = nodes_[b];  // until a node is made
    if (right.op == Op::constant) return add(a, constant(-right.value));
    if (left.op == Op::constant && left.value == 0) return negate(b);
    if (a == b) return constant(0);
    if ((left.kind == Kind::signal) != (right.kind == Kind::signal))
        throw std::logic_error("a signal value can only be subtracted from a signal value");
    if (right.op == Op::negate) return add(a, right.operands[0]);
    if (left.op == Op::negate) return negate(add(left.operands[0], b));
    // a - b and b - a share one node.
    return a < b ? signed_subtract(a, b) : negate(signed_subtract(b, a));
}

Id Graph::signed_subtract(Id a, Id b) {
    Node node;
    node.op = Op::subtract;
    node.kind = joined(nodes_[a].kind, nodes_[b].kind);
    node.operands = {a, b};
    return intern(std::move(node));
}

Id Graph::multiply(Id a, Id b) {
    const Node &left = nodes_[a], &right = nodes_[b];   // until a node is made
    if (left.kind > right.kind) return multiply(b, a);  // the scalar stands on the left
    if (left.kind == Kind::signal) throw std::logic_error("signal values cannot be multiplied by each other");
    if (left.op == Op::constant) {
        if (right.op == Op::constant) return constant(left.value * right.value);
        if (left.value == 0) return constant(0);
        if (left.value == 1) return b;
        if (left.value < 0) return negate(multiply(constant(-left.value), b));
    }
    if (left.op == Op::negate) return negate(multiply(left.operands[0], b));
    if (right.op == Op::negate) return negate(multiply(a, right.operands[0]));
    return signed_multiply(a, b);
}

Id Graph::signed_multiply(Id a, Id b) {
    if (nodes_[a].kind == nodes_[b].kind && a > b) std::swap(a, b);
    Node node;
    node.op = Op::multiply;
    node.kind = joined(nodes_[a].kind, nodes_[b].kind);
    node.operands = {a, b};
    return intern(std::move(node));
}

Id Graph::fused(Id a, Id b, Id c, bool negated_product, bool negated_addend) {
    if (negated_product && nodes_[a].op == Op::constant)
        return fused(constant(-nodes_[a].value), b, c, false, negated_addend);
    if (negated_addend && nodes_[c].op == Op::constant)
        return fused(a, b, constant(-nodes_[c].value), negated_product, false);
    Node node;
    node.op = Op::fused;
    node.kind = joined(joined(nodes_[a].kind, nodes_[b].kind), nodes_[c].kind);
    node.operands = {a, b, c};
    node.negated_product = negated_product;
    node.negated_addend = negated_addend;
    return intern(std::move(node));
}

Id Graph::rotation_scalar(Op op, Operands operands) {
    for (const Id operand : operands)
        if (nodes_[operand].kind == Kind::signal)
            throw std::logic_error("a signal value has no quotient, root or sign");
    Node node;
    node.op = op;
    node.kind = Kind::rotation;
    node.operands = operands;
    return intern(std::move(node));
}

Id Graph::divide(Id a, Id b) { return rotation_scalar(Op::divide, {a, b}); }

Id Graph::square_root(Id a) { return rotation_scalar(Op::square_root, {a}); }

Id Graph::copy_sign(const Number& size, const Number& size_in_float, Id sign) {
    const Id in_double = constant(size), in_float = constant(size_in_float);
    return rotation_scalar(Op::copy_sign, {in_double, in_float, sign});
}

void Graph::set_name(Id id, const std::string& name) {
    if (nodes_[id].name.empty()) nodes_[id].name = name;
    // Users take the sign and compute with what it stands before.
    if (nodes_[id].op == Op::negate) set_name(nodes_[id].operands[0], "minus_" + name);
}

void Graph::copy_labels(Id id, const Node& from) {
    if (nodes_[id].name.empty()) nodes_[id].name = from.name;
    if (nodes_[id].scope.empty()) nodes_[id].scope = from.scope;
    set_most(id, from.most);
}

}  // namespace zonal::graph
