// Common partial sums of the rows of a constant matrix.
//
// Greedy search: of all pairs of rows and all sets of terms that agree in both up to a factor, the set that
// saves most becomes a row of its own, which both then use as one term; rows made so take part in what
// follows. Costs are those of `linear_combination` after fusing. Source of the idea: Paar 1997, "Optimized
// arithmetic for Reed-Solomon encoders" (pairs of terms); Hosangadi, Fallah, Kastner 2006, "Optimizing
// polynomial expressions by algebraic factorization and common subexpression elimination" (sets of terms).
// Limits: no step is ever taken back, and sets agree only where their sizes do: a f + b g is not found in
// c (a f + b g) unless a = b.
#include "graph/shared_sums.hpp"

#include <algorithm>
#include <compare>
#include <span>
#include <tuple>
#include <utility>

#include "graph/sum.hpp"

namespace zonal::graph {

namespace {

using Term = SharedSums::Term;
using Row = SharedSums::Row;

constexpr int kUnit = 0;  ///< the size 1

struct Saving {
    int instructions = 0;
    int multiplications = 0;
    friend auto operator<=>(const Saving&, const Saving&) = default;
};

/// How the terms of a set differ between two rows. Either every term has one size in both rows, and the set's
/// sum keeps the sizes; or all terms have one size in each row, and the set's sum is of ±1.
struct Relation {
    bool keeps_sizes = false;
    int first_size = kUnit;   ///< what the set's sum is multiplied by
    int second_size = kUnit;
    int sign = 1;
    friend auto operator<=>(const Relation&, const Relation&) = default;
};

/// A term that two rows have in common.
struct CommonTerm {
    Relation relation;
    Term in_sum;  ///< as the sum of the set has it, but for the sign of the whole
};

bool by_relation_and_size(const CommonTerm& a, const CommonTerm& b) {
    return std::tie(a.relation, a.in_sum.size, a.in_sum.variable) <
           std::tie(b.relation, b.in_sum.size, b.in_sum.variable);
}

/// Signs are those of the first row.
std::vector<CommonTerm> common_terms(const Row& first, const Row& second) {
    std::vector<CommonTerm> common;
    auto b = second.begin();
    for (const Term& a : first) {
        while (b != second.end() && b->variable < a.variable) ++b;
        if (b == second.end()) break;
        if (b->variable != a.variable) continue;
        const int sign = a.sign * b->sign;
        if (a.size == b->size) common.push_back({{true, kUnit, kUnit, sign}, a});
        if (a.size != kUnit || b->size != kUnit)
            common.push_back({{false, a.size, b->size, sign}, {a.variable, kUnit, a.sign}});
    }
    std::sort(common.begin(), common.end(), by_relation_and_size);
    return common;
}

/// A row under search and what its cost depends on.
class CountedRow {
  public:
    CountedRow(Row row, int size_count) : row_(std::move(row)), uses_(size_count, 0) {
        for (const Term& term : row_) ++uses_[term.size];
    }
    const Row& terms() const { return row_; }
    int uses(int size) const { return uses_[size]; }
    /// A chain that starts from ±1 needs no first multiplication.
    bool has_unit() const { return uses_[kUnit] > 0; }

    /// The terms of a set give way to their sum.
    void replace(const Row& set, const Term& sum) {
        for (const Term& gone : set) remove(gone.variable);
        ++uses_[sum.size];
        row_.push_back(sum);  // the newest variable is the last
    }

  private:
    void remove(int variable) {
        const auto at = std::lower_bound(row_.begin(), row_.end(), variable,
                                         [](const Term& term, int v) { return term.variable < v; });
        --uses_[at->size];
        row_.erase(at);
    }

    Row row_;                ///< variables ascend
    std::vector<int> uses_;  ///< terms of each size
};

using CommonRange = std::span<const CommonTerm>;

/// The terms at the front that agree in what `part` tells of them.
template <class Part>
CommonRange front_run(CommonRange terms, Part part) {
    const auto is_other = [&](const CommonTerm& term) { return part(term) != part(terms.front()); };
    const auto end = std::find_if(terms.begin(), terms.end(), is_other);
    return terms.first(end - terms.begin());
}

const Relation& relation_of(const CommonTerm& term) { return term.relation; }
int size_of(const CommonTerm& term) { return term.in_sum.size; }

/// What it saves to make a set its own row. A row of n terms is n instructions, one less with a ±1 among them;
/// each size but 1 is a multiplication.
Saving saving_of(CommonRange set, const CountedRow& first, const CountedRow& second) {
    const int length = static_cast<int>(set.size());
    // Its sum of ±1 is length - 1 additions, and in both rows one term stands for so many.
    if (!set.front().relation.keeps_sizes) return {length - 1, 0};
    Saving saving{length - first.has_unit() - second.has_unit(), 0};
    while (!set.empty()) {
        const CommonRange same = front_run(set, size_of);
        const int size = size_of(same.front()), count = static_cast<int>(same.size());
        if (size == kUnit)
            ++saving.instructions;
        else
            saving.multiplications += (first.uses(size) == count) + (second.uses(size) == count) - 1;
        set = set.subspan(same.size());
    }
    return saving;
}

struct Sharing {
    Saving saving;
    Relation relation;
};

Sharing best_sharing(const CountedRow& first, const CountedRow& second) {
    Sharing best;
    const std::vector<CommonTerm> common = common_terms(first.terms(), second.terms());
    for (CommonRange rest(common); !rest.empty();) {
        const CommonRange set = front_run(rest, relation_of);
        const Saving saving = saving_of(set, first, second);
        if (saving > best.saving) best = {saving, set.front().relation};
        rest = rest.subspan(set.size());
    }
    return best;
}

class Search {
  public:
    Search(const std::vector<Row>& outputs, int input_count, int size_count)
        : input_count_(input_count), size_count_(size_count) {
        for (const Row& row : outputs) add_row(row);
    }

    std::vector<Row> run() {
        while (const std::optional<Pair> pair = best_pair()) share(*pair);
        std::vector<Row> rows;
        for (const CountedRow& row : rows_) rows.push_back(row.terms());
        return rows;
    }

  private:
    struct Pair {
        int first = 0, second = 0;  ///< first > second
    };

    int row_count() const { return static_cast<int>(rows_.size()); }
    Sharing& sharing(Pair pair) { return sharings_[pair.first][pair.second]; }

    void add_row(const Row& row) {
        rows_.emplace_back(row, size_count_);
        sharings_.emplace_back(row_count() - 1);
        compare_with_all(row_count() - 1);
    }

    void compare_with_all(int row) {
        for (int other = 0; other < row_count(); ++other) {
            if (other == row) continue;
            const Pair pair{std::max(row, other), std::min(row, other)};
            sharing(pair) = best_sharing(rows_[pair.first], rows_[pair.second]);
        }
    }

    /// The first of equals; none when nothing saves anything.
    std::optional<Pair> best_pair() {
        std::optional<Pair> best;
        Saving most;
        for (int first = 0; first < row_count(); ++first)
            for (int second = 0; second < first; ++second)
                if (const Pair pair{first, second}; sharing(pair).saving > most) {
                    best = pair;
                    most = sharing(pair).saving;
                }
        return best;
    }

    void share(Pair pair) {
        const Relation relation = sharing(pair).relation;
        Row set;
        for (const CommonTerm& term : common_terms(rows_[pair.first].terms(), rows_[pair.second].terms()))
            if (term.relation == relation) set.push_back(term.in_sum);
        std::sort(set.begin(), set.end(),
                  [](const Term& a, const Term& b) { return a.variable < b.variable; });
        const int sign = set.front().sign;
        for (Term& term : set) term.sign *= sign;
        const int sum = input_count_ + row_count();
        rows_[pair.first].replace(set, {sum, relation.first_size, sign});
        rows_[pair.second].replace(set, {sum, relation.second_size, sign * relation.sign});
        compare_with_all(pair.first);
        compare_with_all(pair.second);
        add_row(set);
    }

    int input_count_, size_count_;
    std::vector<CountedRow> rows_;
    std::vector<std::vector<Sharing>> sharings_;  ///< [first][second], first > second
};

}  // namespace

SharedSums::SharedSums(Graph& graph, const std::vector<std::vector<Number>>& factors,
                       std::vector<Value> inputs)
    : graph_(&graph), inputs_(std::move(inputs)) {
    std::vector<Number> all{1};
    for (const std::vector<Number>& row : factors) all.insert(all.end(), row.begin(), row.end());
    const std::vector<int> sizes = size_numbers(all);
    for (std::size_t at = 0; at < all.size(); ++at)
        if (sizes[at] == static_cast<int>(sizes_.size())) sizes_.push_back(abs(all[at]));
    std::vector<Row> outputs;
    auto size = sizes.begin() + 1;
    for (const std::vector<Number>& factors_of_row : factors) {
        Row row;
        for (int k = 0; k < static_cast<int>(factors_of_row.size()); ++k, ++size)
            if (factors_of_row[k] != 0) row.push_back({k, *size, factors_of_row[k] < 0 ? -1 : 1});
        outputs.push_back(row);
    }
    rows_ = Search(outputs, static_cast<int>(inputs_.size()), static_cast<int>(sizes_.size())).run();
    made_.resize(rows_.size());
}

Value SharedSums::output(int i) {
    if (made_[i]) return *made_[i];
    const int input_count = static_cast<int>(inputs_.size());
    std::vector<graph::Term> terms;
    for (const Term& term : rows_[i]) {
        const Value value =
            term.variable < input_count ? inputs_[term.variable] : output(term.variable - input_count);
        terms.push_back({term.sign * sizes_[term.size], value});
    }
    made_[i] = linear_combination(*graph_, terms);
    return *made_[i];
}

}  // namespace zonal::graph
