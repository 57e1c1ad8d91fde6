// Common partial sums of the rows of a constant matrix.
//
// Greedy search: of all pairs of rows and all sets of terms that agree in both up to a factor, the set that
// saves most becomes a row of its own, which both then use as one term; rows made so take part in what
// follows. Costs are those of `linear_combination` after fusing.
// Source: Paar 1997, "Optimized arithmetic for Reed-Solomon encoders" (pairs of terms); Hosangadi, Fallah,
// Kastner 2004, "Common subexpression elimination involving multiple variables for linear DSP synthesis".
// Limits: no step is ever taken back. A sum made of proportional terms brings a new constant, their ratio.
#include "graph/shared_sums.hpp"

#include <algorithm>
#include <compare>
#include <span>

#include "graph/sum.hpp"

namespace zonal::graph {

namespace {

using Entry = SharedSums::Entry;
using Row = SharedSums::Row;

constexpr int kUnit = Sizes::kUnit;

struct Saving {
    int instructions = 0;
    int multiplications = 0;
    friend auto operator<=>(const Saving&, const Saving&) = default;
};

/// How the terms of a set differ between two rows: second = sign * quotient * first.
struct Relation {
    int quotient = kUnit;
    int sign = 1;
    friend auto operator<=>(const Relation&, const Relation&) = default;
};

/// A term that two rows have in common; its sign is the first row's.
struct CommonTerm {
    Relation relation;
    int first_size = kUnit, second_size = kUnit;
    int variable = 0;
    int sign = 1;
    friend auto operator<=>(const CommonTerm&, const CommonTerm&) = default;
};

/// Those of one relation side by side, and among them those of one size.
std::vector<CommonTerm> common_terms(const Row& first, const Row& second, Sizes& sizes) {
    std::vector<CommonTerm> common;
    auto b = second.begin();
    for (const Entry& a : first) {
        while (b != second.end() && b->variable < a.variable) ++b;
        if (b == second.end()) break;
        if (b->variable != a.variable) continue;
        const Relation relation{sizes.quotient(b->size, a.size), a.sign * b->sign};
        common.push_back({relation, a.size, b->size, a.variable, a.sign});
    }
    std::sort(common.begin(), common.end());
    return common;
}

bool has_earlier_variable(const Entry& a, const Entry& b) { return a.variable < b.variable; }

int count_of(const Row& row, int size) {
    return static_cast<int>(
        std::count_if(row.begin(), row.end(), [&](const Entry& entry) { return entry.size == size; }));
}

using CommonRange = std::span<const CommonTerm>;

/// The terms at the front that agree in what `part` tells of them.
template <class Part>
CommonRange front_run(CommonRange terms, Part part) {
    const auto is_other = [&](const CommonTerm& term) { return term.*part != terms.front().*part; };
    return terms.first(std::find_if(terms.begin(), terms.end(), is_other) - terms.begin());
}

/// Terms of one relation, counted by size.
struct CommonSet {
    struct Group {
        int first_size, second_size, count;
    };
    Relation relation;
    int length = 0;
    std::vector<Group> groups;
};

CommonSet counted(CommonRange terms) {
    CommonSet set{terms.front().relation, static_cast<int>(terms.size()), {}};
    for (; !terms.empty(); terms = terms.subspan(set.groups.back().count)) {
        const CommonTerm& term = terms.front();
        const int count = static_cast<int>(front_run(terms, &CommonTerm::first_size).size());
        set.groups.push_back({term.first_size, term.second_size, count});
    }
    return set;
}

/// What the sum of a set is multiplied by in both rows; it is the set of the first row divided by `first`.
struct Factors {
    int first = kUnit, second = kUnit;
};

/// A row is an instruction a term, one less where its chain can start from ±1, and a multiplication a size
/// other than 1. So much goes when a set gives way to its sum times `factor`.
Saving saving_in_row(const Row& row, const CommonSet& set, int CommonSet::Group::*size, int factor) {
    Saving saving{set.length - 1, 0};
    int units = count_of(row, kUnit), like_factor = count_of(row, factor);
    const bool had_unit = units > 0;
    for (const CommonSet::Group& group : set.groups) {
        if (group.*size == kUnit)
            units -= group.count;
        else
            saving.multiplications += count_of(row, group.*size) == group.count;
        if (group.*size == factor) like_factor -= group.count;
    }
    if (factor == kUnit)
        ++units;
    else
        saving.multiplications -= like_factor == 0;
    saving.instructions += (units > 0) - had_unit;
    return saving;
}

Saving saving_of(const CommonSet& set, const Row& first, const Row& second, Factors factors) {
    const Saving in_first = saving_in_row(first, set, &CommonSet::Group::first_size, factors.first);
    const Saving in_second = saving_in_row(second, set, &CommonSet::Group::second_size, factors.second);
    const bool has_unit =
        std::any_of(set.groups.begin(), set.groups.end(),
                    [&](const CommonSet::Group& group) { return group.first_size == factors.first; });
    const int sizes = static_cast<int>(set.groups.size());
    return {in_first.instructions + in_second.instructions - (set.length - has_unit),
            in_first.multiplications + in_second.multiplications - (sizes - has_unit)};
}

struct Sharing {
    Saving saving;
    Relation relation;
    Factors factors;
};

/// The sum either keeps the sizes of its terms, if they are the same in both rows, or has one that is 1.
Sharing best_sharing(const Row& first, const Row& second, Sizes& sizes) {
    Sharing best;
    const std::vector<CommonTerm> common = common_terms(first, second, sizes);
    for (CommonRange rest(common); !rest.empty();) {
        const CommonRange terms = front_run(rest, &CommonTerm::relation);
        rest = rest.subspan(terms.size());
        const CommonSet set = counted(terms);
        const auto consider = [&](Factors factors) {
            const Saving saving = saving_of(set, first, second, factors);
            if (saving > best.saving) best = {saving, set.relation, factors};
        };
        if (set.relation.quotient == kUnit) consider({});
        if (set.length == 1) continue;
        for (const CommonSet::Group& group : set.groups) consider({group.first_size, group.second_size});
    }
    return best;
}

/// The terms of a set give way to their sum.
void replace(Row& row, const Row& set, const Entry& sum) {
    for (const Entry& gone : set)
        std::erase_if(row, [&](const Entry& entry) { return entry.variable == gone.variable; });
    row.push_back(sum);  // the newest variable is the last
}

class Search {
  public:
    Search(const std::vector<Row>& outputs, int input_count, Sizes& sizes)
        : input_count_(input_count), sizes_(sizes) {
        for (const Row& row : outputs) add_row(row);
    }

    std::vector<Row> run() {
        while (const std::optional<Pair> pair = best_pair()) share(*pair);
        return rows_;
    }

  private:
    struct Pair {
        int first = 0, second = 0;  ///< first > second
    };

    int row_count() const { return static_cast<int>(rows_.size()); }
    Sharing& sharing(Pair pair) { return sharings_[pair.first][pair.second]; }

    void add_row(const Row& row) {
        rows_.push_back(row);
        sharings_.emplace_back(row_count() - 1);
        compare_with_all(row_count() - 1);
    }

    void compare_with_all(int row) {
        for (int other = 0; other < row_count(); ++other) {
            if (other == row) continue;
            const Pair pair{std::max(row, other), std::min(row, other)};
            sharing(pair) = best_sharing(rows_[pair.first], rows_[pair.second], sizes_);
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

    /// The set of the first row divided by its factor.
    Row sum_of(Pair pair, const Sharing& shared) {
        Row sum;
        for (const CommonTerm& term : common_terms(rows_[pair.first], rows_[pair.second], sizes_))
            if (term.relation == shared.relation)
                sum.push_back(
                    {term.variable, sizes_.quotient(term.first_size, shared.factors.first), term.sign});
        std::sort(sum.begin(), sum.end(), has_earlier_variable);
        return sum;
    }

    void share(Pair pair) {
        const Sharing shared = sharing(pair);
        Row sum = sum_of(pair, shared);
        // It begins with a plus, so that a sum and its negative are one row.
        const int sign = sum.front().sign;
        for (Entry& entry : sum) entry.sign *= sign;
        const int variable = input_count_ + row_count();
        replace(rows_[pair.first], sum, {variable, shared.factors.first, sign});
        replace(rows_[pair.second], sum, {variable, shared.factors.second, sign * shared.relation.sign});
        compare_with_all(pair.first);
        compare_with_all(pair.second);
        add_row(sum);
    }

    int input_count_;
    Sizes& sizes_;
    std::vector<Row> rows_;                       ///< variables ascend
    std::vector<std::vector<Sharing>> sharings_;  ///< [first][second], first > second
};

}  // namespace

SharedSums::SharedSums(Graph& graph, const std::vector<std::vector<Number>>& factors,
                       std::vector<Value> inputs)
    : graph_(&graph), inputs_(std::move(inputs)) {
    std::vector<Row> outputs;
    for (const std::vector<Number>& of_output : factors) {
        Row row;
        for (int k = 0; k < static_cast<int>(of_output.size()); ++k)
            if (of_output[k] != 0)
                row.push_back({k, sizes_.number_of(of_output[k]), of_output[k] < 0 ? -1 : 1});
        outputs.push_back(row);
    }
    rows_ = Search(outputs, static_cast<int>(inputs_.size()), sizes_).run();
    made_.resize(rows_.size());
}

Value SharedSums::output(int i) {
    if (made_[i]) return *made_[i];
    const int input_count = static_cast<int>(inputs_.size());
    std::vector<Term> terms;
    for (const Entry& entry : rows_[i]) {
        const Value value =
            entry.variable < input_count ? inputs_[entry.variable] : output(entry.variable - input_count);
        terms.push_back({entry.sign * sizes_[entry.size], value});
    }
    made_[i] = linear_combination(*graph_, terms);
    return *made_[i];
}

}  // namespace zonal::graph
