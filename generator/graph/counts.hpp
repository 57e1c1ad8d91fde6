#pragma once

#include "graph/kernel.hpp"

namespace zonal::graph {

/// Counts the computed nodes of an optimized kernel (none is dead) whose scope starts with `scope`.
Cost count_operations(const Kernel& kernel, const std::string& scope = "");

}  // namespace zonal::graph
