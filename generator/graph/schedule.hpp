#pragma once

#include "graph/kernel.hpp"

namespace zonal::graph {

/// One line of the emitted body: compute a node, or store an output.
struct Statement {
    bool is_store = false;
    Id node = -1;   ///< the node to compute, or the one to store
    int index = 0;  ///< store only: the element of the output
};

/// Orders a kernel group by group (a group is a band): what the group needs and earlier ones have not
/// computed, in the order it was built (lobe by lobe), then its stores.
std::vector<Statement> schedule(const Kernel& kernel);

/// True when no statement reads an element of `input` after that element of the output was stored: the kernel
/// may then write over that input.
bool is_safe_in_place(const Kernel& kernel, const std::vector<Statement>& statements, int input);

/// Largest number of computed values that are waiting to be used at one time. Inputs are memory operands and
/// constants are literals: neither counts.
int peak_live_values(const Kernel& kernel, const std::vector<Statement>& statements);

/// What a machine of so many registers moves to and from memory because values wait longer than registers
/// last: the value needed furthest in the future goes first (Belady 1966). Inputs and constants are memory
/// operands.
struct Spills {
    int stores = 0;
    int reloads = 0;
};
Spills simulate_spills(const Kernel& kernel, const std::vector<Statement>& statements, int registers);

}  // namespace zonal::graph
