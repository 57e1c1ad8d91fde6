#pragma once

#include "graph/kernel.hpp"

namespace zonal::graph {

/// About how many cycles one of many calls takes on a processor that runs instructions out of order: each
/// call with data of its own, so that its chains overlap with the next call as far as waiting instructions
/// have room. `channels`: scalars that a signal value holds.
///
/// A model with committed constants: what follows from it is the same on every machine.
double call_cycles(const Kernel& kernel, int channels = 1);

}  // namespace zonal::graph
