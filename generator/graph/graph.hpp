#pragma once

#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

#include "exact/real.hpp"

namespace zonal::graph {

/// Constants stay at 50 digits until a printer rounds them once.
using Number = exact::Real;

/// What a value depends on. A *rotation scalar* depends on the rotation only and is paid once per rotation; a
/// *signal value* is linear in the input vector and is paid once per vector.
enum class Kind { constant, rotation, signal };

/// `fused` is (±a) * b ± c, rounded once where the target can.
/// `copy_sign` is a constant with the last operand's sign: the first operand, in single precision the second
/// one. Division, root and copied sign make rotation scalars only.
enum class Op { constant, input, negate, add, subtract, multiply, fused, divide, square_root, copy_sign };

/// Names a node of one graph; smaller ids were made earlier, so ids are a topological order.
using Id = int;

/// At most three.
class Operands {
  public:
    Operands() = default;
    Operands(std::initializer_list<Id> ids) : size_(static_cast<int>(ids.size())) {
        std::copy(ids.begin(), ids.end(), ids_.begin());
    }
    int size() const { return size_; }
    Id operator[](int k) const { return ids_[k]; }
    const Id* begin() const { return ids_.data(); }
    const Id* end() const { return ids_.data() + size_; }
    friend bool operator==(const Operands&, const Operands&) = default;

  private:
    std::array<Id, 3> ids_{-1, -1, -1};
    int size_ = 0;
};

struct Node {
    Op op = Op::constant;
    Kind kind = Kind::constant;
    Operands operands;  ///< in the order they are written; multiply: the scalar first; fused: a, b, c
    bool negated_product = false;  ///< fused only
    bool negated_addend = false;   ///< fused only
    Number value = 0;              ///< constant only
    int array = 0;                 ///< input only: which of the kernel's inputs
    int index = 0;                 ///< input only: which element of it
    std::string name;              ///< what the value means, for printers; empty: the scope and a number
    std::string scope;             ///< the part of the kernel that made it, such as "b3_d2"
    /// What its magnitude does not exceed, where its builder knows.
    double most = std::numeric_limits<double>::infinity();
};

/// An expression graph that knows no language and no spherical harmonics. Building it folds constants, shares
/// equal expressions (one node an expression, whatever the order of operands) and moves signs outwards, so
/// that a*b and -a*b share their product. A signal value is only ever added to another or multiplied by a
/// constant or a rotation scalar; anything else throws std::logic_error. So every kernel is linear by
/// construction.
class Graph {
  public:
    Id constant(const Number& value);
    Id input(Kind kind, int array, int index);
    Id add(Id a, Id b);
    Id subtract(Id a, Id b);
    Id multiply(Id a, Id b);
    Id negate(Id a);
    Id divide(Id a, Id b);
    Id square_root(Id a);
    Id copy_sign(const Number& size, const Number& size_in_float, Id sign);
    /// (±a) * b ± c. For passes; builders write products and sums.
    Id fused(Id a, Id b, Id c, bool negated_product, bool negated_addend);
    /// The product with a signed constant kept as it is, the difference the way round it is written. For
    /// passes.
    Id signed_multiply(Id a, Id b);
    Id signed_subtract(Id a, Id b);

    const Node& operator[](Id id) const { return nodes_[id]; }
    int size() const { return static_cast<int>(nodes_.size()); }
    /// For a graph that will have so many nodes.
    void reserve(int size);

    /// Values made from here on belong to this part of the kernel.
    void set_scope(std::string scope) { scope_ = std::move(scope); }
    /// Gives a value its meaning, and with "minus_" what it is the negative of; the first name stays.
    void set_name(Id id, const std::string& name);
    /// Says that a scalar's magnitude is at most so much.
    void set_most(Id id, double most) { nodes_[id].most = std::min(nodes_[id].most, most); }
    /// Copies name, scope and largest magnitude of another graph's node, for passes that rebuild a graph.
    void copy_labels(Id id, const Node& from);

  private:
    /// What makes two nodes that are no constants the same.
    struct Key {
        Op op;
        Operands operands;
        bool negated_product, negated_addend;
        int array, index;
        friend bool operator==(const Key&, const Key&) = default;
    };
    struct KeyHash {
        std::size_t operator()(const Key& key) const;
    };
    Id intern(Node node);
    Id append(Node node);
    Id rotation_scalar(Op op, Operands operands);

    std::vector<Node> nodes_;
    std::multimap<double, Id> constants_;         ///< by what they are nearest to
    std::unordered_map<Key, Id, KeyHash> known_;  ///< all others
    std::string scope_;
};

/// A handle that lets builders write formulas: `x * y + z`. An expression makes at most one product beside
/// values that have a name: C++ leaves the order of operands to the compiler, and nodes are numbered as they
/// are made.
struct Value {
    Graph* graph = nullptr;
    Id id = -1;
};
inline Value operator+(Value a, Value b) { return {a.graph, a.graph->add(a.id, b.id)}; }
inline Value operator-(Value a, Value b) { return {a.graph, a.graph->subtract(a.id, b.id)}; }
inline Value operator*(Value a, Value b) { return {a.graph, a.graph->multiply(a.id, b.id)}; }
inline Value operator/(Value a, Value b) { return {a.graph, a.graph->divide(a.id, b.id)}; }
inline Value operator-(Value a) { return {a.graph, a.graph->negate(a.id)}; }
inline Value sqrt(Value a) { return {a.graph, a.graph->square_root(a.id)}; }
/// What is small beside rounding and large beside the smallest numbers depends on the precision: hence two
/// sizes.
inline Value copysign(const Number& size, const Number& size_in_float, Value sign) {
    return {sign.graph, sign.graph->copy_sign(size, size_in_float, sign.id)};
}
inline Value operator/(const Number& a, Value b) {
    return {b.graph, b.graph->divide(b.graph->constant(a), b.id)};
}
inline Value operator*(const Number& a, Value b) {
    return {b.graph, b.graph->multiply(b.graph->constant(a), b.id)};
}
inline Value operator+(Value a, const Number& b) {
    return {a.graph, a.graph->add(a.id, a.graph->constant(b))};
}

}  // namespace zonal::graph
