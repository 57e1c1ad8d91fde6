#include "bounds/body_hash.hpp"

#include <fmt/format.h>

#include "emit/text.hpp"
#include "graph/schedule.hpp"
#include "io/sha256.hpp"

namespace zonal {

namespace {

using graph::Id;
using graph::Kernel;
using graph::Node;
using graph::Op;

const char* name_of(Op op) {
    switch (op) {
        case Op::constant:
            return "constant";
        case Op::input:
            return "input";
        case Op::negate:
            return "negate";
        case Op::add:
            return "add";
        case Op::subtract:
            return "subtract";
        case Op::multiply:
            return "multiply";
        case Op::fused:
            return "fused";
        case Op::divide:
            return "divide";
        case Op::square_root:
            return "root";
        case Op::copy_sign:
            return "copy_sign";
    }
    return "";
}

/// The body in words that know no names: values are numbered as they are computed.
std::string statements_of(const Kernel& kernel) {
    std::vector<int> numbers(kernel.graph.size(), -1);
    int computed = 0;
    const auto operand = [&](Id id) {
        const Node& node = kernel.graph[id];
        if (node.op == Op::constant) return emit::literal(node.value);
        if (node.op == Op::input) return fmt::format("{}[{}]", node.array, node.index);
        return fmt::format("v{}", numbers[id]);
    };
    std::string text;
    for (const graph::Statement& statement : graph::schedule(kernel)) {
        if (statement.is_store) {
            text += fmt::format("out {} {}\n", statement.index, operand(statement.node));
            continue;
        }
        const Node& node = kernel.graph[statement.node];
        numbers[statement.node] = computed++;
        text += fmt::format("{}{}{}", name_of(node.op), node.negated_product ? " -" : "",
                            node.negated_addend ? " +-" : "");
        for (const Id id : node.operands) text += " " + operand(id);
        text += "\n";
    }
    return text;
}

}  // namespace

std::string body_hash(const Kernel& kernel, const std::vector<Kernel>& kernels) {
    const std::string before =
        kernel.name == "apply" ? statements_of(graph::kernel_named(kernels, "prepare")) : "";
    return short_sha256(before + statements_of(kernel));
}

}  // namespace zonal
