// Expression graphs as straight-line code in any language with infix formulas.
#include "emit/straight_line.hpp"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "emit/text.hpp"
#include "graph/schedule.hpp"

namespace zonal::emit {

namespace {

using graph::Id;
using graph::Kernel;
using graph::Kind;
using graph::Node;
using graph::Op;

class StatementPrinter {
  public:
    StatementPrinter(const Kernel& kernel, const Syntax& syntax, int indentation)
        : kernel_(kernel), syntax_(syntax), names_(node_names(kernel)), indentation_(indentation, ' ') {}

    std::string print() {
        load_rotation();
        for (const graph::Statement& statement : graph::schedule(kernel_)) {
            const Node& node = kernel_.graph[statement.node];
            append(statement.is_store
                       ? fmt::format("{}[{}] = {};", kernel_.output.name, statement.index,
                                     operand(statement.node))
                       : syntax_.declare(node.kind, names_.at(statement.node), expression(node)));
        }
        return body_;
    }

  private:
    void append(const std::string& statement) { body_ += indentation_ + statement + "\n"; }

    /// The rotation is read once, before anything is written.
    void load_rotation() {
        for (Id id = 0; id < kernel_.graph.size(); ++id) {
            const Node& node = kernel_.graph[id];
            if (node.op == Op::input && node.kind == Kind::rotation)
                append(syntax_.declare(Kind::rotation, names_.at(id),
                                       fmt::format("{}[{}]", kernel_.inputs[node.array].name, node.index)));
        }
    }

    std::string operand(Id id, bool is_negated = false) const {
        const Node& node = kernel_.graph[id];
        const std::string sign = is_negated ? "-" : "";
        if (node.op == Op::constant) return syntax_.constant(is_negated ? -node.value : node.value);
        if (node.op == Op::input && node.kind == Kind::signal)
            return fmt::format("{}{}[{}]", sign, kernel_.inputs[node.array].name, node.index);
        return sign + names_.at(id);
    }

    std::string expression(const Node& node) const {
        const auto text = [&](int k) { return operand(node.operands[k]); };
        switch (node.op) {
            case Op::negate:
                return operand(node.operands[0], true);
            case Op::add:
                return fmt::format("{} + {}", text(0), text(1));
            case Op::subtract:
                return fmt::format("{} - {}", text(0), text(1));
            case Op::multiply:
                return fmt::format("{} * {}", text(0), text(1));
            case Op::fused:
                return syntax_.fused(operand(node.operands[0], node.negated_product), text(1),
                                     operand(node.operands[2], node.negated_addend));
            case Op::divide:
                return fmt::format("{} / {}", text(0), text(1));
            case Op::square_root:
                return fmt::format("sqrt({})", text(0));
            case Op::copy_sign:
                return syntax_.copy_sign(kernel_.graph[node.operands[0]].value,
                                         kernel_.graph[node.operands[1]].value, text(2));
            case Op::constant:
            case Op::input:
                break;
        }
        throw std::logic_error("constants and inputs are operands, not statements");
    }

    const Kernel& kernel_;
    const Syntax& syntax_;
    std::map<Id, std::string> names_;
    std::string indentation_;
    std::string body_;
};

}  // namespace

std::string product_and_sum(const std::string& a, const std::string& b, const std::string& c) {
    return c.starts_with('-') ? fmt::format("{} * {} - {}", a, b, c.substr(1))
                              : fmt::format("{} * {} + {}", a, b, c);
}

std::string print_statements(const Kernel& kernel, const Syntax& syntax, int indentation) {
    return StatementPrinter(kernel, syntax, indentation).print();
}

}  // namespace zonal::emit
