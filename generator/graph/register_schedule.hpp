#pragma once

#include "graph/schedule.hpp"

namespace zonal::graph {

/// Orders a kernel for machines that hold inputs and values in registers alike and do not reorder arithmetic:
/// GPUs. Reading an input is a statement here: a rotation scalar just before its first use, the signal not
/// later than the first store of its group, or, where groups are mixed, not later than the first store at
/// all: what is safe in place stays so. Of a few orders, that which needs the fewest registers; that of
/// `schedule` where none needs fewer. `channels`: how many registers hold a signal value.
std::vector<Statement> schedule_for_registers(const Kernel& kernel, int channels = 1);

/// Largest number of registers that inputs and values hold at one time, in such an order.
int peak_registers(const Kernel& kernel, const std::vector<Statement>& statements, int channels = 1);

}  // namespace zonal::graph
