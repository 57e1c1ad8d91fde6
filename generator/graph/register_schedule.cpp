// Orders statements so that few values wait at one time.
//
// A list schedule from the last statement back to the first: among the values whose every reader stands
// behind already, the next is one that leaves the fewest registers held before it; among equals the one that
// was built last, so that lobe follows lobe and row follows row, or the one found last, so that a sum is
// followed to its beginnings. Band by band; over all bands at once; or so once all that is made of the signal
// alone is there. `rotate_zhf` of order 6 needs 149 registers band by band, since every lobe waits for every
// band, 90 lobe by lobe, and 83 when the weights come first; on a ring, where two lobes far apart share what
// their weights are made of, 171, 132 and 97. A kernel that has steps is scheduled step by step.
// Source: Sethi 1975, "Complete Register Allocation Problems": the least number is NP-complete, so this is
// greedy and the best of a few.
#include "graph/register_schedule.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <utility>

namespace zonal::graph {

namespace {

using Groups = std::vector<std::vector<Statement>>;
enum class Tie { built_last, found_last };

/// Registers that hold a node.
int width(const Node& node, int channels) {
    if (node.op == Op::constant) return 0;
    return node.kind == Kind::signal ? channels : 1;
}

/// What a statement reads, each once, by id.
std::vector<Id> operands_of(const Kernel& kernel, const Statement& statement) {
    if (statement.is_store) return {statement.node};
    const Operands& operands = kernel.graph[statement.node].operands;
    std::vector<Id> all(operands.begin(), operands.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
    return all;
}

/// The order of `schedule`, group by group, or step by step where there are steps.
Groups scheduled_groups(Kernel kernel) {
    if (kernel.has_steps())
        for (Store& store : kernel.stores) store.group = store.step;
    std::map<int, int> group_of;  // by the element that is stored
    for (const Store& store : kernel.stores) group_of[store.index] = store.group;
    std::map<int, std::vector<Statement>> groups;
    std::vector<Statement> open;
    for (const Statement& statement : schedule(kernel)) {
        open.push_back(statement);
        if (!statement.is_store) continue;
        std::vector<Statement>& group = groups[group_of.at(statement.index)];
        group.insert(group.end(), open.begin(), open.end());
        open.clear();
    }
    Groups all;
    for (auto& [number, group] : groups) all.push_back(std::move(group));
    return all;
}

/// One group from its last statement to its first.
class BackwardScheduler {
  public:
    /// `is_live`: what later groups need.
    BackwardScheduler(const Kernel& kernel, int channels, Tie tie, std::vector<bool>& is_live)
        : kernel_(kernel), channels_(channels), tie_(tie), is_live_(is_live) {}

    std::vector<Statement> run(const std::vector<Statement>& group) {
        for (const Statement& statement : group) {
            Item item{statement, operands_of(kernel_, statement)};
            for (const Id operand : item.operands) ++readers_[operand];
            if (statement.is_store)
                ready_.push_back(std::move(item));
            else
                waiting_.emplace(statement.node, std::move(item));
        }
        for (auto& [id, item] : waiting_)
            if (!readers_.contains(id)) ready_.push_back(std::move(item));  // later groups read it
        std::vector<Statement> backward;
        while (!ready_.empty()) backward.push_back(place(take_best()));
        std::reverse(backward.begin(), backward.end());
        return backward;
    }

  private:
    struct Item {
        Statement statement;
        std::vector<Id> operands;
    };

    Item take_best() {
        auto best = ready_.begin();
        int least = std::numeric_limits<int>::max();
        for (auto item = ready_.begin(); item != ready_.end(); ++item) {
            const int growth = growth_of(*item);
            const bool wins_tie = tie_ == Tie::found_last || item->statement.node >= best->statement.node;
            if (growth > least || (growth == least && !wins_tie)) continue;
            least = growth;
            best = item;
        }
        Item item = std::move(*best);
        ready_.erase(best);
        return item;
    }

    int width_of(Id id) const { return width(kernel_.graph[id], channels_); }

    /// How many more registers are held before the statement than after it.
    int growth_of(const Item& item) const {
        int growth = item.statement.is_store ? 0 : -width_of(item.statement.node);
        for (const Id operand : item.operands)
            if (!is_live_[operand]) growth += width_of(operand);
        return growth;
    }

    Statement place(const Item& item) {
        if (!item.statement.is_store) is_live_[item.statement.node] = false;
        for (const Id operand : item.operands) {
            is_live_[operand] = true;
            if (--readers_[operand] > 0) continue;
            const auto found = waiting_.find(operand);
            if (found != waiting_.end()) ready_.push_back(std::move(found->second));
        }
        return item.statement;
    }

    const Kernel& kernel_;
    int channels_;
    Tie tie_;
    std::vector<bool>& is_live_;
    std::vector<Item> ready_;
    std::map<Id, Item> waiting_;  ///< for their readers
    std::map<Id, int> readers_;
};

/// Groups from the last to the first.
Groups schedule_backward(const Kernel& kernel, Groups groups, int channels, Tie tie) {
    std::vector<bool> is_live(kernel.graph.size(), false);
    for (auto group = groups.rbegin(); group != groups.rend(); ++group)
        *group = BackwardScheduler(kernel, channels, tie, is_live).run(*group);
    return groups;
}

/// Each value stored as soon as it is there.
Groups store_at_once(Groups groups) {
    for (std::vector<Statement>& group : groups) {
        std::multimap<Id, Statement> stores;
        std::set<Id> computed;
        for (const Statement& statement : group)
            if (statement.is_store)
                stores.emplace(statement.node, statement);
            else
                computed.insert(statement.node);
        std::vector<Statement> all;
        const auto store = [&](Id id) {
            const auto [first, last] = stores.equal_range(id);
            for (auto it = first; it != last; ++it) all.push_back(it->second);
        };
        for (const Statement& statement : std::exchange(group, {})) {
            if (!statement.is_store) all.push_back(statement);
            if (!statement.is_store || !computed.contains(statement.node)) store(statement.node);
            if (statement.is_store) stores.erase(statement.node);
        }
        group = std::move(all);
    }
    return groups;
}

Groups all_as_one(const Groups& groups) {
    std::vector<Statement> all;
    for (const std::vector<Statement>& group : groups) all.insert(all.end(), group.begin(), group.end());
    return {all};
}

/// What is made of the signal alone, and then all else.
Groups signal_first(const Kernel& kernel, const Groups& groups) {
    std::vector<bool> is_turned(kernel.graph.size(), false);
    std::vector<Statement> before, after;
    for (const std::vector<Statement>& group : groups) {
        for (const Statement& statement : group) {
            const Node& node = kernel.graph[statement.node];
            is_turned[statement.node] =
                node.kind == Kind::rotation || std::ranges::any_of(node.operands, [&](Id id) {
                    return is_turned[id] || kernel.graph[id].kind == Kind::rotation;
                });
            (statement.is_store || is_turned[statement.node] ? after : before).push_back(statement);
        }
    }
    return {before, after};
}

/// Inputs become statements.
std::vector<Statement> with_reads(const Kernel& kernel, const Groups& groups) {
    std::vector<Statement> all;
    std::set<Id> read;
    const auto read_inputs = [&](const Statement& statement, bool is_signal_only) {
        for (const Id id : operands_of(kernel, statement)) {
            const Node& node = kernel.graph[id];
            if (node.op != Op::input || (is_signal_only && node.kind != Kind::signal)) continue;
            if (read.insert(id).second) all.push_back({false, id, 0});
        }
    };
    for (const std::vector<Statement>& group : groups) {
        bool has_stored = false;
        for (auto statement = group.begin(); statement != group.end(); ++statement) {
            if (statement->is_store && !std::exchange(has_stored, true))
                for (auto later = statement; later != group.end(); ++later) read_inputs(*later, true);
            read_inputs(*statement, false);
            all.push_back(*statement);
        }
    }
    return all;
}

}  // namespace

int peak_registers(const Kernel& kernel, const std::vector<Statement>& statements, int channels) {
    std::vector<int> last_use(kernel.graph.size(), -1);
    for (int at = 0; at < static_cast<int>(statements.size()); ++at)
        for (const Id operand : operands_of(kernel, statements[at])) last_use[operand] = at;
    int held = 0, peak = 0;
    for (int at = 0; at < static_cast<int>(statements.size()); ++at) {
        for (const Id operand : operands_of(kernel, statements[at]))
            if (last_use[operand] == at) held -= width(kernel.graph[operand], channels);
        if (!statements[at].is_store) held += width(kernel.graph[statements[at].node], channels);
        peak = std::max(peak, held);
    }
    return peak;
}

std::vector<Statement> schedule_for_registers(const Kernel& kernel, int channels) {
    const Groups built = scheduled_groups(kernel);
    std::vector<Statement> best = with_reads(kernel, built);
    int least = peak_registers(kernel, best, channels);
    const auto consider = [&](const Groups& groups) {
        std::vector<Statement> other = with_reads(kernel, groups);
        const int registers = peak_registers(kernel, other, channels);
        if (registers >= least) return;
        least = registers;
        best = std::move(other);
    };
    consider(store_at_once(built));
    std::vector<Groups> forms{built};
    if (!kernel.has_steps()) {
        forms.push_back(all_as_one(built));
        if (kernel.uses(Kind::rotation)) forms.push_back(signal_first(kernel, built));
    }
    for (const Groups& groups : forms)
        for (const Tie tie : {Tie::built_last, Tie::found_last})
            consider(schedule_backward(kernel, groups, channels, tie));
    return best;
}

}  // namespace zonal::graph
