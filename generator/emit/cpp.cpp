// Prints expression graphs as C++: one statement a node, products with the scalar on the left.
#include "emit/cpp.hpp"

#include <fmt/format.h>

#include <cctype>
#include <sstream>
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

const char* const kPrelude = R"(
// One instruction where the target has it, a product and a sum elsewhere, never a library call.
// ZONAL_NO_FMA: always a product and a sum; with -ffp-contract=off the same bits everywhere.
#if !defined(ZONAL_NO_FMA) && (defined(__FMA__) || defined(__ARM_FEATURE_FMA))
inline float fma(float a, float b, float c) { return __builtin_fmaf(a, b, c); }
inline double fma(double a, double b, double c) { return __builtin_fma(a, b, c); }
#else
inline float fma(float a, float b, float c) { return a * b + c; }
inline double fma(double a, double b, double c) { return a * b + c; }
#endif

// The scalar that multiplies a signal value: V itself, or V::value_type where V is a vector.
template <class V, class = void>
struct scalar_of {
    using type = V;
};
template <class V>
struct scalar_of<V, std::void_t<typename V::value_type>> {
    using type = typename V::value_type;
};
)";

bool uses(const Kernel& kernel, Kind kind) {
    if (kernel.output.kind == kind) return true;
    for (const graph::Array& array : kernel.inputs)
        if (array.kind == kind) return true;
    return false;
}

const char* type_of(Kind kind) { return kind == Kind::signal ? "V" : "T"; }

std::string template_line(const Kernel& kernel) {
    if (!uses(kernel, Kind::signal)) return "template <class T>\n";
    if (!uses(kernel, Kind::rotation)) return "template <class V, class T = typename scalar_of<V>::type>\n";
    return "template <class T, class V = T>\n";
}

std::string parameters(const Kernel& kernel) {
    std::string text;
    for (const graph::Array& array : kernel.inputs)
        text += fmt::format("const {}* {}, ", type_of(array.kind), array.name);
    return text + fmt::format("{}* {}", type_of(kernel.output.kind), kernel.output.name);
}

/// rotate_zhf -> RotateZhf
std::string pascal_case(const std::string& name) {
    std::string result;
    bool is_start = true;
    for (const char c : name) {
        if (c != '_') result += is_start ? static_cast<char>(std::toupper(c)) : c;
        is_start = c == '_';
    }
    return result;
}

std::string comment_lines(const std::string& text) {
    std::string result;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) result += "/// " + line + "\n";
    return result;
}

std::string kernel_comment(const Kernel& kernel) {
    std::string text = comment_lines(kernel.summary);
    const auto describe = [&](const graph::Array& array) {
        text += fmt::format("/// {} : {} values, {}.\n", array.name, array.size, array.comment);
    };
    for (const graph::Array& array : kernel.inputs) describe(array);
    describe(kernel.output);
    const graph::Array& last = kernel.inputs.back();
    text +=
        last.kind == kernel.output.kind
            ? fmt::format("/// {} may be {}; they must not overlap in part.\n", kernel.output.name, last.name)
            : fmt::format("/// {} must not overlap {}.\n", kernel.output.name, last.name);
    if (!kernel.bound_excess.empty())
        text += fmt::format("/// Error: at most the banner's bound and {}, times |{}|.\n",
                            kernel.bound_excess, last.name);
    text += "/// Cost: see the banner.\n";
    return text + fmt::format("/// Source: {}.\n", kernel.source);
}

/// The body of one kernel.
class BodyPrinter {
  public:
    explicit BodyPrinter(const Kernel& kernel) : kernel_(kernel), names_(node_names(kernel)) {}

    std::string print() {
        const std::vector<graph::Statement> statements = graph::schedule(kernel_);
        check_in_place(statements);
        load_rotation();
        for (const graph::Statement& statement : statements) {
            const Node& node = kernel_.graph[statement.node];
            if (statement.is_store)
                body_ += fmt::format("    {}[{}] = {};\n", kernel_.output.name, statement.index,
                                     operand(statement.node));
            else
                body_ += fmt::format("    const {} {} = {};\n", type_of(node.kind), names_.at(statement.node),
                                     expression(node));
        }
        return body_;
    }

  private:
    void check_in_place(const std::vector<graph::Statement>& statements) const {
        for (int k = 0; k < static_cast<int>(kernel_.inputs.size()); ++k)
            if (kernel_.inputs[k].kind == Kind::signal && !graph::is_safe_in_place(kernel_, statements, k))
                throw std::logic_error(kernel_.name + " reads what it has overwritten");
    }

    /// The rotation is read once, before anything is written.
    void load_rotation() {
        for (Id id = 0; id < kernel_.graph.size(); ++id) {
            const Node& node = kernel_.graph[id];
            if (node.op == Op::input && node.kind == Kind::rotation)
                body_ += fmt::format("    const T {} = {}[{}];\n", names_.at(id),
                                     kernel_.inputs[node.array].name, node.index);
        }
    }

    std::string operand(Id id, bool is_negated = false) const {
        const Node& node = kernel_.graph[id];
        const std::string sign = is_negated ? "-" : "";
        if (node.op == Op::constant)
            return fmt::format("T({})", literal(is_negated ? -node.value : node.value));
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
                return fmt::format("fma({}, {}, {})", operand(node.operands[0], node.negated_product),
                                   text(1), operand(node.operands[2], node.negated_addend));
            case Op::divide:
                return fmt::format("{} / {}", text(0), text(1));
            case Op::square_root:
                return fmt::format("sqrt({})", text(0));
            case Op::copy_sign:
                return fmt::format("copysign({}, {})", text(0), text(1));
            case Op::constant:
            case Op::input:
                break;
        }
        throw std::logic_error("constants and inputs are operands, not statements");
    }

    const Kernel& kernel_;
    std::map<Id, std::string> names_;
    std::string body_;
};

std::string print_kernel(const Kernel& kernel) {
    return fmt::format("\n{}{}void {}({}) {{\n{}}}\n", kernel_comment(kernel), template_line(kernel),
                       kernel.name, parameters(kernel), BodyPrinter(kernel).print());
}

std::string print_bounds(const Unit& unit) {
    std::string text;
    for (const auto& [kernel, bound] : unit.bounds) {
        text += fmt::format("\n/// Largest relative error of {}, {}.\n", kernel, unit.domain);
        text += fmt::format("inline constexpr double k{}BoundFloat = {};\n", pascal_case(kernel),
                            bound.float_text);
        text += fmt::format("inline constexpr double k{}BoundDouble = {};\n", pascal_case(kernel),
                            bound.double_text);
    }
    return text;
}

std::string print_forward(const Unit& unit, const Forward& forward) {
    for (const Kernel& kernel : unit.kernels) {
        if (kernel.name != forward.target) continue;
        std::string arguments;
        for (const graph::Array& array : kernel.inputs) arguments += array.name + ", ";
        return fmt::format("\n{}{}void {}({}) {{\n    {}({}{});\n}}\n", comment_lines(forward.summary),
                           template_line(kernel), forward.name, parameters(kernel), kernel.name, arguments,
                           kernel.output.name);
    }
    throw std::logic_error("no kernel named " + forward.target);
}

}  // namespace

std::string print_cpp(const Unit& unit) {
    std::string text;
    for (const std::string& line : banner_lines(unit)) text += "// " + line + "\n";
    text += fmt::format("#pragma once\n\n#include <type_traits>\n\nnamespace zonal::{} {{\n", unit.name);
    text += kPrelude;
    text += print_bounds(unit);
    for (const Kernel& kernel : unit.kernels) text += print_kernel(kernel);
    for (const Forward& forward : unit.forwards) text += print_forward(unit, forward);
    return text + fmt::format("\n}}  // namespace zonal::{}\n", unit.name);
}

}  // namespace zonal::emit
