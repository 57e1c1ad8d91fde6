#pragma once

#include <vector>

#include "graph/graph.hpp"

namespace zonal::graph {

struct Term {
    Number factor;
    Value value;
};

/// sum_i factor_i * value_i with as few multiplications as additions allow for free: terms whose factors
/// agree in size are added first and multiplied once, factors ±1 are not multiplied, zeros vanish. The number
/// of instructions after fusing is the number of nonzero terms either way. Precondition: `terms` not empty.
Value linear_combination(Graph& graph, const std::vector<Term>& terms);

}  // namespace zonal::graph
