#pragma once

#include "graph/kernel.hpp"

namespace zonal::graph {

/// Turns a + x*y into one fused instruction wherever that removes the product: a product all of whose uses
/// are sums is fused into each of them; a product that something else needs stays and is added.
Kernel form_fused(Kernel kernel);

/// Moves a minus sign in front of an output into the instruction that makes it, where that costs nothing.
Kernel absorb_negations(Kernel kernel);

/// Drops what no output needs. Order, names and scopes stay.
Kernel remove_dead(Kernel kernel);

/// The two halves of a kernel for many vectors of one rotation. `prepare` stores the rotation scalars that
/// signal values are multiplied by, in the order they are needed; `apply` takes them in place of the rotation
/// (input 0). Names and texts of both are the caller's.
struct Halves {
    Kernel prepare;
    Kernel apply;
};
Halves split_by_kind(const Kernel& kernel);

/// All of the above but the split, in the order that every kernel is emitted with. (Folding of constants and
/// sharing of equal expressions happen while a graph is built.)
Kernel optimize(Kernel kernel);

}  // namespace zonal::graph
