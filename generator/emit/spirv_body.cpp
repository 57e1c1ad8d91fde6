// Prints an expression graph as SPIR-V instructions: one or two a value.
#include "emit/spirv_body.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "emit/text.hpp"
#include "graph/register_schedule.hpp"

namespace zonal::emit {

namespace {

using graph::Id;
using graph::Kernel;
using graph::Kind;
using graph::Node;
using graph::Op;

/// How instructions refer to a name.
std::string id_of(const std::string& name) { return fmt::format("%{}", name); }

/// The arithmetic of a kernel, and its loads and stores.
class BodyPrinter {
  public:
    BodyPrinter(const Kernel& kernel, const SpirvForm& form, SpirvDeclarations& declarations,
                SpirvMemory& memory)
        : kernel_(kernel),
          form_(form),
          declarations_(declarations),
          memory_(memory),
          names_(node_names(kernel)) {
        note_scaled_products();
    }

    SpirvBody print() {
        for (const graph::Statement& statement :
             graph::schedule_for_registers(kernel_, form_.has_channels ? 3 : 1)) {
            const Node& node = kernel_.graph[statement.node];
            if (statement.is_store)
                body_ += memory_.store(statement.index, operand(statement.node));
            else if (node.op == Op::input)
                body_ += memory_.load(node.array, node.index, operand(statement.node).substr(1));
            else
                print_value(statement.node);
        }
        return {body_, fixed_results_};
    }

  private:
    /// c (a b): a compiler that takes it for (c a) b keeps c a in a register for whatever else c a meets.
    /// (Mesa's does, and held 50 more registers for dense blocks of order 6.) Nothing is lost where a b
    /// must stay: a factor is never contracted.
    void note_scaled_products() {
        const auto is_constant = [&](Id id) { return kernel_.graph[id].op == Op::constant; };
        for (Id id = 0; id < kernel_.graph.size(); ++id) {
            const Node& node = kernel_.graph[id];
            if (node.op != Op::multiply && node.op != Op::fused) continue;
            for (const int k : {0, 1}) {
                const Id factor = node.operands[k];
                if (is_constant(node.operands[1 - k]) && kernel_.graph[factor].op == Op::multiply)
                    scaled_products_.insert(factor);
            }
        }
    }

    bool is_signal(Id id) const { return kernel_.graph[id].kind == Kind::signal; }

    std::string type_of(Id id) {
        if (!form_.has_channels || !is_signal(id)) return "%float";
        return declarations_.type("rgb", "OpTypeVector %float 3");
    }

    std::string operand(Id id) {
        const Node& node = kernel_.graph[id];
        if (node.op == Op::constant) return declarations_.number(float_literal(node.value));
        if (node.op != Op::input || node.kind != Kind::signal) return id_of(names_.at(id));
        return fmt::format("%in_{}_{}", kernel_.inputs[node.array].name, node.index);
    }

    std::string append(const std::string& name, const std::string& instruction) {
        body_ += fmt::format("%{} = {}\n", name, instruction);
        if (form_.is_precise) fixed_results_.push_back(name);
        return id_of(name);
    }

    std::string negated(Id id) {
        const Node& node = kernel_.graph[id];
        if (node.op == Op::constant) return declarations_.number(float_literal(-node.value));
        const std::string value = operand(id);
        const std::string name = value.substr(1) + "_minus";
        if (negated_.insert(id).second) append(name, fmt::format("OpFNegate {} {}", type_of(id), value));
        return id_of(name);
    }

    /// (±a) b. A signal of channels is a vector and its factor a scalar.
    std::string product(Id a, Id b, const std::string& type) {
        const std::string x = operand(a), y = operand(b);
        return form_.has_channels && is_signal(b) && !is_signal(a)
                   ? fmt::format("OpVectorTimesScalar {} {} {}", type, y, x)
                   : fmt::format("OpFMul {} {} {}", type, x, y);
    }

    void print_fused(const std::string& name, const Node& node, const std::string& type) {
        const std::string product_name =
            append(name + "_p", product(node.operands[0], node.operands[1], type));
        const std::string addend = operand(node.operands[2]);
        if (!node.negated_product)
            append(name, fmt::format("{} {} {} {}", node.negated_addend ? "OpFSub" : "OpFAdd", type,
                                     product_name, addend));
        else if (!node.negated_addend)
            append(name, fmt::format("OpFSub {} {} {}", type, addend, product_name));
        else
            append(name, fmt::format("OpFSub {} {} {}", type, negated(node.operands[2]), product_name));
    }

    /// By bits: a comparison with 0 would take -0 for +0.
    void print_copy_sign(const std::string& name, const Node& node) {
        const std::string size_mask = declarations_.unsigned_integer(0x7fffffffu);
        const std::string sign_mask = declarations_.unsigned_integer(0x80000000u);
        const auto bits = [&](const std::string& suffix, Id id, const std::string& mask) {
            const std::string value = operand(id);
            body_ += fmt::format(
                "%{0}_{1}_bits = OpBitcast %uint {2}\n%{0}_{1} = OpBitwiseAnd %uint %{0}_{1}_bits {3}\n",
                name, suffix, value, mask);
        };
        bits("size", node.operands[1], size_mask);
        bits("sign", node.operands[2], sign_mask);
        body_ += fmt::format(
            "%{0}_bits = OpBitwiseOr %uint %{0}_size %{0}_sign\n%{0} = OpBitcast %float %{0}_bits\n", name);
    }

    void print_value(Id id) {
        const Node& node = kernel_.graph[id];
        const std::string& name = names_.at(id);
        const std::string type = type_of(id);
        const auto binary = [&](const char* instruction) {
            const std::string a = operand(node.operands[0]), b = operand(node.operands[1]);
            append(name, fmt::format("{} {} {} {}", instruction, type, a, b));
        };
        switch (node.op) {
            case Op::negate:
                append(name, fmt::format("OpFNegate {} {}", type, operand(node.operands[0])));
                return;
            case Op::add:
                return binary("OpFAdd");
            case Op::subtract:
                return binary("OpFSub");
            case Op::multiply:
                append(name, product(node.operands[0], node.operands[1], type));
                if (!form_.is_precise && scaled_products_.contains(id)) fixed_results_.push_back(name);
                return;
            case Op::fused:
                return print_fused(name, node, type);
            case Op::divide:
                return binary("OpFDiv");
            case Op::square_root:
                append(name, fmt::format("OpExtInst {} %glsl Sqrt {}", type, operand(node.operands[0])));
                return;
            case Op::copy_sign:
                return print_copy_sign(name, node);
            case Op::constant:
            case Op::input:
                break;
        }
        throw std::logic_error("constants and inputs are operands, not statements");
    }

    const Kernel& kernel_;
    SpirvForm form_;
    SpirvDeclarations& declarations_;
    SpirvMemory& memory_;
    std::map<Id, std::string> names_;
    std::set<Id> negated_;
    std::set<Id> scaled_products_;  ///< products of which a constant's product is made
    std::vector<std::string> fixed_results_;
    std::string body_;
};

}  // namespace

SpirvDeclarations::SpirvDeclarations() {
    type("void", "OpTypeVoid");
    type("float", "OpTypeFloat 32");
}

std::string SpirvDeclarations::type(const std::string& name, const std::string& definition) {
    if (names_.insert(name).second) text_ += fmt::format("%{} = {}\n", name, definition);
    return id_of(name);
}

std::string SpirvDeclarations::unsigned_integer(unsigned value) {
    type("uint", "OpTypeInt 32 0");
    return type(fmt::format("uint_{}", value), fmt::format("OpConstant %uint {}", value));
}

std::string SpirvDeclarations::number(const std::string& digits) {
    const auto known = numbers_.emplace(digits, fmt::format("float_{}", numbers_.size() + 1)).first;
    return type(known->second, fmt::format("OpConstant %float {}", digits));
}

SpirvBody print_spirv_body(const Kernel& kernel, const SpirvForm& form, SpirvDeclarations& declarations,
                           SpirvMemory& memory) {
    return BodyPrinter(kernel, form, declarations, memory).print();
}

}  // namespace zonal::emit
