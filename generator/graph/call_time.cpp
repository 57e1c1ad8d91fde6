#include "graph/call_time.hpp"

#include <algorithm>
#include <vector>

#include "graph/schedule.hpp"

namespace zonal::graph {

namespace {

// Round numbers of server cores of 2020 to 2025 (Fog, "Instruction tables"): two pipes for arithmetic in
// floating point, one divider, a scheduler from which instructions are issued as their operands are ready,
// the oldest first.
constexpr int kPipes = 2;
constexpr int kWaiting = 64;    // instructions that the scheduler holds
constexpr int kDispatched = 6;  // that enter it in a cycle
constexpr int kLoad = 5;        // cycles until a value of memory is there
constexpr int kCalls = 4;

struct Timing {
    int latency = 0;
    int divider = 0;  ///< cycles that the divider is taken
};

Timing timing_of(Op op) {
    switch (op) {
        case Op::divide:
            return {11, 4};
        case Op::square_root:
            return {14, 6};
        case Op::copy_sign:
            return {2, 0};
        case Op::negate:
            return {1, 0};
        default:
            return {4, 0};
    }
}

struct Instruction {
    Timing timing;
    std::vector<int> operands;  ///< earlier instructions of the call
};

/// A call as instructions; a signal value takes one a channel.
std::vector<Instruction> instructions_of(const Kernel& kernel, int channels) {
    std::vector<Instruction> call;
    std::vector<std::vector<int>> made_by(kernel.graph.size());
    for (const Statement& statement : schedule(kernel)) {
        const Node& node = kernel.graph[statement.node];
        if (statement.is_store || node.op == Op::input || node.op == Op::constant) continue;
        for (int channel = 0; channel < (node.kind == Kind::signal ? channels : 1); ++channel) {
            Instruction instruction{timing_of(node.op), {}};
            for (const Id operand : node.operands) {
                const std::vector<int>& makers = made_by[operand];
                if (!makers.empty())
                    instruction.operands.push_back(makers[channel % static_cast<int>(makers.size())]);
            }
            made_by[statement.node].push_back(static_cast<int>(call.size()));
            call.push_back(std::move(instruction));
        }
    }
    return call;
}

/// The cycle in which the last of some calls ends.
int cycles_of(const std::vector<Instruction>& call, int calls) {
    const int size = static_cast<int>(call.size());
    std::vector<int> ready(static_cast<std::size_t>(size) * calls, -1);  // when its value is there
    std::vector<int> waiting;
    int next = 0, divider_is_free = 0, last = 0;
    for (int cycle = kLoad; next < size * calls || !waiting.empty(); ++cycle) {
        for (int k = 0; k < kDispatched && next < size * calls; ++k)
            if (static_cast<int>(waiting.size()) < kWaiting) waiting.push_back(next++);
        int issued = 0;
        std::erase_if(waiting, [&](int at) {
            const Instruction& instruction = call[at % size];
            const auto is_there = [&](int operand) {
                const int when = ready[at - at % size + operand];
                return when >= 0 && when <= cycle;
            };
            if (issued == kPipes || !std::ranges::all_of(instruction.operands, is_there)) return false;
            if (instruction.timing.divider > 0 && divider_is_free > cycle) return false;
            if (instruction.timing.divider > 0) divider_is_free = cycle + instruction.timing.divider;
            ready[at] = cycle + instruction.timing.latency;
            last = std::max(last, ready[at]);
            ++issued;
            return true;
        });
    }
    return last;
}

}  // namespace

double call_cycles(const Kernel& kernel, int channels) {
    const std::vector<Instruction> call = instructions_of(kernel, channels);
    if (call.empty()) return 0;
    return static_cast<double>(cycles_of(call, 2 * kCalls) - cycles_of(call, kCalls)) / kCalls;
}

}  // namespace zonal::graph
