#include "graph/schedule.hpp"

#include <algorithm>
#include <set>

namespace zonal::graph {

namespace {

bool is_computed(const Node& node) { return node.op != Op::constant && node.op != Op::input; }

}  // namespace

std::vector<Statement> schedule(const Kernel& kernel) {
    std::vector<Statement> statements;
    std::vector<bool> is_done(kernel.graph.size(), false);
    std::set<int> groups;
    for (const Store& store : kernel.stores) groups.insert(store.group);
    for (const int group : groups) {
        std::vector<bool> is_needed(kernel.graph.size(), false);
        for (const Store& store : kernel.stores)
            if (store.group == group) is_needed[store.value] = true;
        for (Id id = kernel.graph.size() - 1; id >= 0; --id)
            if (is_needed[id] && !is_done[id])
                for (const Id operand : kernel.graph[id].operands) is_needed[operand] = true;
        for (Id id = 0; id < kernel.graph.size(); ++id) {
            if (!is_needed[id] || is_done[id] || !is_computed(kernel.graph[id])) continue;
            statements.push_back({false, id, 0});
            is_done[id] = true;
        }
        for (const Store& store : kernel.stores)
            if (store.group == group) statements.push_back({true, store.value, store.index});
    }
    return statements;
}

bool is_safe_in_place(const Kernel& kernel, const std::vector<Statement>& statements, int input) {
    std::set<int> overwritten;
    const auto reads_overwritten = [&](const Node& node) {
        return node.op == Op::input && node.array == input && overwritten.contains(node.index);
    };
    for (const Statement& statement : statements) {
        const Node& node = kernel.graph[statement.node];
        if (statement.is_store) {
            if (reads_overwritten(node)) return false;
            overwritten.insert(statement.index);
        } else if (std::any_of(node.operands.begin(), node.operands.end(),
                               [&](Id operand) { return reads_overwritten(kernel.graph[operand]); })) {
            return false;
        }
    }
    return true;
}

int peak_live_values(const Kernel& kernel, const std::vector<Statement>& statements) {
    std::vector<int> last_use(kernel.graph.size(), -1);
    for (int at = 0; at < static_cast<int>(statements.size()); ++at) {
        const Statement& statement = statements[at];
        if (statement.is_store)
            last_use[statement.node] = at;
        else
            for (const Id operand : kernel.graph[statement.node].operands) last_use[operand] = at;
    }
    int live = 0, peak = 0;
    std::set<Id> ended;
    for (int at = 0; at < static_cast<int>(statements.size()); ++at) {
        const Statement& statement = statements[at];
        const auto end_if_last = [&](Id id) {
            if (is_computed(kernel.graph[id]) && last_use[id] == at && ended.insert(id).second) --live;
        };
        if (statement.is_store) {
            end_if_last(statement.node);
        } else {
            for (const Id operand : kernel.graph[statement.node].operands) end_if_last(operand);
            peak = std::max(peak, ++live);
        }
    }
    return peak;
}

Spills simulate_spills(const Kernel& kernel, const std::vector<Statement>& statements, int registers) {
    const auto operands_of = [&](const Statement& statement) {
        std::vector<Id> computed;
        const Operands all =
            statement.is_store ? Operands{statement.node} : kernel.graph[statement.node].operands;
        for (const Id id : all)
            if (is_computed(kernel.graph[id])) computed.push_back(id);
        return computed;
    };
    std::vector<std::vector<int>> uses(kernel.graph.size());  // last first
    for (int at = static_cast<int>(statements.size()) - 1; at >= 0; --at)
        for (const Id id : operands_of(statements[at])) uses[id].push_back(at);

    Spills spills;
    std::set<Id> held, saved;
    const auto make_room = [&](const std::vector<Id>& pinned) {
        if (static_cast<int>(held.size()) < registers) return;
        Id furthest = -1;
        for (const Id id : held) {
            if (std::find(pinned.begin(), pinned.end(), id) != pinned.end()) continue;
            if (furthest < 0 || uses[id].back() > uses[furthest].back()) furthest = id;
        }
        held.erase(furthest);
        if (saved.insert(furthest).second) ++spills.stores;
    };
    for (int at = 0; at < static_cast<int>(statements.size()); ++at) {
        const std::vector<Id> operands = operands_of(statements[at]);
        for (const Id id : operands) {
            if (held.contains(id)) continue;
            make_room(operands);
            held.insert(id);
            ++spills.reloads;
        }
        for (const Id id : operands) {
            while (!uses[id].empty() && uses[id].back() <= at) uses[id].pop_back();
            if (uses[id].empty()) held.erase(id);
        }
        if (statements[at].is_store) continue;
        make_room({});
        held.insert(statements[at].node);
    }
    return spills;
}

}  // namespace zonal::graph
