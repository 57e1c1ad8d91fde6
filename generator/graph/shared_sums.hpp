#pragma once

#include <optional>
#include <vector>

#include "graph/graph.hpp"
#include "graph/sizes.hpp"

namespace zonal::graph {

/// All outputs of a constant matrix times a vector of values, with the partial sums that several outputs have
/// in common made once: as few instructions after fusing as a greedy search finds, and among equals as few
/// multiplications. The search compares whole numbers only, so it finds the same on every machine.
class SharedSums {
  public:
    /// `factors[i][k]` is what output i multiplies input k by; zeros vanish. Preconditions: rows as long as
    /// `inputs`, and none of zeros only.
    SharedSums(Graph& graph, const std::vector<std::vector<Number>>& factors, std::vector<Value> inputs);

    /// Output i. What it needs and no output asked for before is made here, in the scope that is set.
    Value output(int i);

    /// A factor ±size of a variable: an input, or behind the inputs a row.
    struct Entry {
        int variable = 0;
        int size = Sizes::kUnit;
        int sign = 1;
    };
    /// A sum to make: an output, or behind the outputs what others have in common.
    using Row = std::vector<Entry>;

  private:
    Graph* graph_;
    std::vector<Value> inputs_;
    Sizes sizes_;
    std::vector<Row> rows_;
    std::vector<std::optional<Value>> made_;  ///< a row's value, once it was asked for
};

}  // namespace zonal::graph
