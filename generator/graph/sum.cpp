#include "graph/sum.hpp"

#include "graph/sizes.hpp"

namespace zonal::graph {

namespace {

/// Terms of one |factor|, and only their signs.
struct Group {
    Number size;
    std::vector<Term> terms;
};

/// ±1 come first: they start the chain, and every other group can then be fused into it.
std::vector<Group> group_by_size(const std::vector<Term>& terms) {
    Sizes sizes;
    std::vector<Group> groups{{Number(1), {}}};
    for (const Term& term : terms) {
        if (term.factor == 0) continue;
        const int number = sizes.number_of(term.factor);
        if (number == static_cast<int>(groups.size())) groups.push_back({sizes[number], {}});
        groups[number].terms.push_back({term.factor < 0 ? Number(-1) : Number(1), term.value});
    }
    return groups;
}

}  // namespace

Value linear_combination(Graph& graph, const std::vector<Term>& terms) {
    Value sum{&graph, graph.constant(0)};
    for (const Group& group : group_by_size(terms)) {
        if (group.size == 1) {
            for (const Term& term : group.terms) sum = sum + term.factor * term.value;
            continue;
        }
        // The sign of the first term is the group's, so that a sum and its negative share one node.
        Value inner{&graph, graph.constant(0)};
        const Number sign = group.terms.front().factor;
        for (const Term& term : group.terms) inner = inner + (sign * term.factor) * term.value;
        sum = sum + (sign * group.size) * inner;
    }
    return sum;
}

}  // namespace zonal::graph
