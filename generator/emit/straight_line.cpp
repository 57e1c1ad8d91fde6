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

    /// The rotation is read once, before anything is written.
    void load_rotation() {
        for (Id id = 0; id < kernel_.graph.size(); ++id) {
            const Node& node = kernel_.graph[id];
            if (node.op == Op::input && node.kind == Kind::rotation)
                append(syntax_.declare(Kind::rotation, names_.at(id),
                                       syntax_.element(kernel_.inputs[node.array], node.index)));
        }
    }

    /// Those that `is_printed` says of a value's kind; a store is of the output's.
    template <class Choice>
    void print(Choice is_printed) {
        for (const graph::Statement& statement : graph::schedule(kernel_)) {
            const Node& node = kernel_.graph[statement.node];
            if (!is_printed(statement.is_store ? kernel_.output.kind : node.kind)) continue;
            append(statement.is_store
                       ? fmt::format("{} = {};", syntax_.element(kernel_.output, statement.index),
                                     operand(statement.node))
                       : syntax_.declare(node.kind, names_.at(statement.node), expression(node)));
        }
    }

    const std::string& text() const { return body_; }

  private:
    void append(const std::string& statement) {
        constexpr std::size_t kColumns = 100;
        if (indentation_.size() + statement.size() <= kColumns) {
            body_ += indentation_ + statement + "\n";
            return;
        }
        const std::size_t value = statement.find(" = ") + 3;
        body_ += fmt::format("{0}{1}\n{0}    {2}\n", indentation_, statement.substr(0, value - 1),
                             statement.substr(value));
    }

    std::string operand(Id id, bool is_negated = false) const {
        const Node& node = kernel_.graph[id];
        const std::string sign = is_negated ? "-" : "";
        if (node.op == Op::constant) return syntax_.constant(is_negated ? -node.value : node.value);
        if (node.op == Op::input && node.kind == Kind::signal)
            return sign + syntax_.element(kernel_.inputs[node.array], node.index);
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
                return syntax_.square_root(text(0));
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

std::string Syntax::square_root(const std::string& a) const { return fmt::format("sqrt({})", a); }

std::string Syntax::element(const graph::Array& array, int index) const {
    return fmt::format("{}[{}]", array.name, index);
}

std::string print_statements(const Kernel& kernel, const Syntax& syntax, int indentation) {
    StatementPrinter printer(kernel, syntax, indentation);
    printer.load_rotation();
    printer.print([](Kind) { return true; });
    return printer.text();
}

std::string print_statements_of(Kind kind, const Kernel& kernel, const Syntax& syntax, int indentation) {
    StatementPrinter printer(kernel, syntax, indentation);
    if (kind == Kind::rotation) printer.load_rotation();
    printer.print([&](Kind other) { return other == kind; });
    return printer.text();
}

}  // namespace zonal::emit
