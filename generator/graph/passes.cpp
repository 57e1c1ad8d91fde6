#include "graph/passes.hpp"

#include <algorithm>
#include <utility>

namespace zonal::graph {

namespace {

std::vector<std::vector<Id>> users_of(const Graph& graph) {
    std::vector<std::vector<Id>> users(graph.size());
    for (Id id = 0; id < graph.size(); ++id)
        for (const Id operand : graph[id].operands) users[operand].push_back(id);
    return users;
}

/// Makes the same node again over new operands.
Id rebuild(Graph& graph, const Node& node, const std::vector<Id>& moved) {
    const auto operand = [&](int k) { return moved[node.operands[k]]; };
    Id id = -1;
    switch (node.op) {
        case Op::constant:
            id = graph.constant(node.value);
            break;
        case Op::input:
            id = graph.input(node.kind, node.array, node.index);
            break;
        case Op::negate:
            id = graph.negate(operand(0));
            break;
        case Op::add:
            id = graph.add(operand(0), operand(1));
            break;
        case Op::subtract:
            id = graph.signed_subtract(operand(0), operand(1));
            break;
        case Op::multiply:
            id = graph.signed_multiply(operand(0), operand(1));
            break;
        case Op::divide:
            id = graph.divide(operand(0), operand(1));
            break;
        case Op::square_root:
            id = graph.square_root(operand(0));
            break;
        case Op::copy_sign: {
            const Number size = graph[operand(0)].value, size_in_float = graph[operand(1)].value;
            id = graph.copy_sign(size, size_in_float, operand(2));
            break;
        }
        case Op::fused:
            id = graph.fused(operand(0), operand(1), operand(2), node.negated_product, node.negated_addend);
            break;
    }
    graph.copy_labels(id, node);
    return id;
}

}  // namespace

Kernel form_fused(Kernel kernel) {
    const Graph old = std::exchange(kernel.graph, {});
    const auto users = users_of(old);
    std::vector<bool> is_output(old.size(), false);
    for (const Store& store : kernel.stores) is_output[store.value] = true;

    // fused_operand[sum]: which of its two operands becomes the product of the fused instruction, or -1.
    std::vector<int> fused_operand(old.size(), -1);
    const auto operand_position = [&](Id sum, Id product) { return old[sum].operands[0] == product ? 0 : 1; };
    const auto try_fuse = [&](Id product) {
        const auto& uses = users[product];
        const bool can_go =
            !is_output[product] && !uses.empty() && std::all_of(uses.begin(), uses.end(), [&](Id use) {
                const Op op = old[use].op;
                return (op == Op::add || op == Op::subtract) && fused_operand[use] < 0 &&
                       old[use].operands[0] != old[use].operands[1];
            });
        if (!can_go) return;
        for (const Id use : uses) fused_operand[use] = operand_position(use, product);
    };
    // Products with one use first: fusing them never costs another product its chance to be shared.
    for (const bool is_single : {true, false})
        for (Id id = 0; id < old.size(); ++id)
            if (old[id].op == Op::multiply && (users[id].size() == 1) == is_single) try_fuse(id);

    Graph& graph = kernel.graph;
    graph.reserve(old.size());
    std::vector<Id> moved(old.size(), -1);
    for (Id id = 0; id < old.size(); ++id) {
        const Node& node = old[id];
        if (fused_operand[id] < 0) {
            moved[id] = rebuild(graph, node, moved);
            continue;
        }
        const int position = fused_operand[id];
        const Node& product = old[node.operands[position]];
        const Id addend = moved[node.operands[1 - position]];
        const bool is_difference = node.op == Op::subtract;
        moved[id] = graph.fused(moved[product.operands[0]], moved[product.operands[1]], addend,
                                is_difference && position == 1, is_difference && position == 0);
        graph.copy_labels(moved[id], node);
    }
    for (Store& store : kernel.stores) store.value = moved[store.value];
    return kernel;
}

Kernel absorb_negations(Kernel kernel) {
    Graph& graph = kernel.graph;
    const auto users = users_of(graph);
    std::vector<bool> is_output(graph.size(), false);
    for (const Store& store : kernel.stores) is_output[store.value] = true;
    for (Store& store : kernel.stores) {
        const Node negation = graph[store.value];
        if (negation.op != Op::negate) continue;
        const Id negated = negation.operands[0];
        if (users[negated].size() > 1 || is_output[negated]) continue;
        const Node inner = graph[negated];
        Id id = -1;
        if (inner.op == Op::multiply && graph[inner.operands[0]].op == Op::constant) {
            id = graph.signed_multiply(graph.constant(-graph[inner.operands[0]].value), inner.operands[1]);
        } else if (inner.op == Op::subtract) {
            id = graph.signed_subtract(inner.operands[1], inner.operands[0]);
        } else if (inner.op == Op::fused) {
            id = graph.fused(inner.operands[0], inner.operands[1], inner.operands[2], !inner.negated_product,
                             !inner.negated_addend);
        }
        if (id < 0) continue;
        graph.copy_labels(id, inner);
        store.value = id;
    }
    return kernel;
}

Kernel remove_dead(Kernel kernel) {
    const Graph old = std::exchange(kernel.graph, {});
    std::vector<bool> is_needed(old.size(), false);
    for (const Store& store : kernel.stores) is_needed[store.value] = true;
    for (Id id = old.size() - 1; id >= 0; --id)
        if (is_needed[id])
            for (const Id operand : old[id].operands) is_needed[operand] = true;

    kernel.graph.reserve(old.size());
    std::vector<Id> moved(old.size(), -1);
    for (Id id = 0; id < old.size(); ++id)
        if (is_needed[id]) moved[id] = rebuild(kernel.graph, old[id], moved);
    for (Store& store : kernel.stores) store.value = moved[store.value];
    return kernel;
}

Halves split_by_kind(const Kernel& kernel) {
    const Graph& old = kernel.graph;
    Halves halves{kernel, kernel};
    halves.apply.graph = {};
    halves.prepare.stores.clear();
    Graph& graph = halves.apply.graph;
    std::vector<Id> moved(old.size(), -1);
    const auto move_scalar = [&](Id id) {
        if (moved[id] >= 0) return;
        const int index = static_cast<int>(halves.prepare.stores.size());
        moved[id] = graph.input(Kind::rotation, 0, index);
        graph.copy_labels(moved[id], old[id]);
        halves.prepare.stores.push_back({index, id, 0});
    };
    for (Id id = 0; id < old.size(); ++id) {
        const Node& node = old[id];
        if (node.kind == Kind::constant) moved[id] = rebuild(graph, node, moved);
        if (node.kind != Kind::signal) continue;
        for (const Id operand : node.operands)
            if (old[operand].kind == Kind::rotation) move_scalar(operand);
        moved[id] = rebuild(graph, node, moved);
    }
    for (Store& store : halves.apply.stores) store.value = moved[store.value];
    const int count = static_cast<int>(halves.prepare.stores.size());
    halves.apply.inputs[0].size = count;
    halves.prepare.inputs.resize(1);
    halves.prepare.output.kind = Kind::rotation;
    halves.prepare.output.size = count;
    halves.prepare = remove_dead(std::move(halves.prepare));
    halves.apply = remove_dead(std::move(halves.apply));
    return halves;
}

Kernel optimize(Kernel kernel) {
    // Dead users would keep products from being fused, so they go first.
    return remove_dead(absorb_negations(form_fused(remove_dead(std::move(kernel)))));
}

}  // namespace zonal::graph
