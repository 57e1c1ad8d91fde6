#include "graph/sum.hpp"

#include <algorithm>
#include <numeric>

namespace zonal::graph {

namespace {

/// Factors that agree to this relative difference are one constant; they carry 50 digits less the condition.
const Number kSameConstant{"1e-35"};

bool is_same_size(const Number& a, const Number& b) { return abs(abs(a) - abs(b)) <= kSameConstant * abs(a); }

struct Group {
    Number size;              // |factor|, exactly 1 where it is ±1
    std::vector<Term> terms;  // factor: the sign
};

std::vector<Group> group_by_size(const std::vector<Term>& terms) {
    std::vector<Group> groups;
    for (const Term& term : terms) {
        if (term.factor == 0) continue;
        const Term signed_term{term.factor < 0 ? Number(-1) : Number(1), term.value};
        const auto group = std::find_if(groups.begin(), groups.end(),
                                        [&](const Group& g) { return is_same_size(g.size, term.factor); });
        if (group != groups.end()) {
            group->terms.push_back(signed_term);
        } else {
            const bool is_one = is_same_size(Number(1), term.factor);
            groups.push_back({is_one ? Number(1) : Number(abs(term.factor)), {signed_term}});
        }
    }
    return groups;
}

}  // namespace

Value linear_combination(Graph& graph, const std::vector<Term>& terms) {
    // Groups of ±1 come first: they start the chain, and every other group can then be fused into it.
    std::vector<Group> groups = group_by_size(terms);
    std::stable_partition(groups.begin(), groups.end(), [](const Group& g) { return g.size == 1; });
    Value sum{&graph, graph.constant(0)};
    for (const Group& group : groups) {
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

std::vector<int> size_numbers(const std::vector<Number>& factors) {
    const int count = static_cast<int>(factors.size());
    std::vector<int> by_size(count);
    std::iota(by_size.begin(), by_size.end(), 0);
    std::stable_sort(by_size.begin(), by_size.end(),
                     [&](int a, int b) { return abs(factors[a]) < abs(factors[b]); });
    std::vector<int> first_equal(count);  // the earliest factor of that size
    for (int begin = 0, end = 0; begin < count; begin = end) {
        while (end < count && is_same_size(factors[by_size[begin]], factors[by_size[end]])) ++end;
        const int first = *std::min_element(by_size.begin() + begin, by_size.begin() + end);
        for (int at = begin; at < end; ++at) first_equal[by_size[at]] = first;
    }
    std::vector<int> numbers(count);
    int next = 0;
    for (int i = 0; i < count; ++i) numbers[i] = first_equal[i] == i ? next++ : numbers[first_equal[i]];
    return numbers;
}

}  // namespace zonal::graph
