#pragma once

#include <vector>

#include "graph/kernel.hpp"

namespace zonal::graph {

/// Where a program finds a value: scratch slots of rotation scalars or of signal values, its constants, an
/// input array or the output.
enum class Memory { rotation_slots, signal_slots, constants, input, output };

struct Place {
    Memory memory = Memory::constants;
    int array = 0;  ///< input only: which one
    auto operator<=>(const Place&) const = default;
};

/// Elements start, start + step, start + 2 step, ...
struct Elements {
    int start = 0;
    int step = 0;
    auto operator<=>(const Elements&) const = default;
};

/// The same operation on elements that follow each other evenly: a loop without a list of indices.
struct Run {
    int count = 0;
    Elements result;
    std::vector<Elements> operands;
};

/// How the runs of a loop lie. `even`: results are neighbours, operands are neighbours or one and the same,
/// as `steps` says for all runs; `spaced`: as each run says; `scattered`: runs of one element.
enum class Spacing { even, spaced, scattered };

/// Runs of one operation, in one form: places, signs and spacing are equal. Op::input copies an element of an
/// input into a slot, Op::constant copies a slot or a constant to the output. No run reads what another run
/// of its loop writes.
struct Loop {
    Op op = Op::constant;
    bool negated_product = false;  ///< fused only
    bool negated_addend = false;   ///< fused only
    Place result;
    std::vector<Place> operands;
    Spacing spacing = Spacing::scattered;
    std::vector<int> steps;  ///< of the operands of even runs
    std::vector<Run> runs;
};

/// A kernel as data: loops in order, the constants and the scratch memory they need.
struct Program {
    std::vector<Loop> loops;
    std::vector<Number> constants;
    int rotation_slots = 0;
    int signal_slots = 0;
};

/// Turns a kernel into loops that do the same operations. Groups of stores keep their order and read before
/// they write, as in `schedule`; within a group, values of equal depth and operation become one loop. Slots
/// are used again once every reader of their value has run.
Program make_program(const Kernel& kernel);

}  // namespace zonal::graph
