// Prints expression graphs as SPIR-V: one instruction or two a value.
#include "emit/spirv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>

#include "emit/text.hpp"
#include "graph/register_schedule.hpp"

namespace zonal::emit {

namespace {

using graph::Id;
using graph::Kernel;
using graph::Kind;
using graph::Node;
using graph::Op;

/// Vectors a workgroup turns unless SpecId 0 says otherwise.
constexpr int kWorkgroupSize = 64;

/// How a module's signal values and arithmetic are.
struct Form {
    bool has_channels = false;  ///< three a signal value
    bool is_precise = false;    ///< products and sums are never contracted
};

/// How instructions refer to a name.
std::string id_of(const std::string& name) { return fmt::format("%{}", name); }

/// The types and constants that a module uses, each declared once, in the order they were asked for.
class Declarations {
  public:
    Declarations() {
        type("void", "OpTypeVoid");
        type("float", "OpTypeFloat 32");
    }
    std::string type(const std::string& name, const std::string& definition) {
        return declare(name, definition);
    }
    std::string unsigned_integer(unsigned value) {
        type("uint", "OpTypeInt 32 0");
        return declare(fmt::format("uint_{}", value), fmt::format("OpConstant %uint {}", value));
    }
    std::string number(const std::string& digits) {
        const auto known = numbers_.emplace(digits, fmt::format("float_{}", numbers_.size() + 1)).first;
        return declare(known->second, fmt::format("OpConstant %float {}", digits));
    }
    const std::string& text() const { return text_; }

  private:
    std::string declare(const std::string& name, const std::string& definition) {
        if (names_.insert(name).second) text_ += fmt::format("%{} = {}\n", name, definition);
        return id_of(name);
    }
    std::string text_;
    std::set<std::string> names_;
    std::map<std::string, std::string> numbers_;  ///< by their digits
};

/// Where a kernel's arrays are.
class Memory {
  public:
    virtual ~Memory() = default;
    /// Instructions that make %name the value at `index` of an input.
    virtual std::string load(int input, int index, const std::string& name) = 0;
    virtual std::string store(int index, const std::string& value) = 0;
    /// Between two steps of a kernel.
    virtual std::string end_step() = 0;
};

/// The arithmetic of a kernel, and its loads and stores.
class BodyPrinter {
  public:
    /// `prefix` keeps the identifiers of a module's functions apart.
    BodyPrinter(const Kernel& kernel, const Form& form, const std::string& prefix, Declarations& declarations,
                Memory& memory)
        : kernel_(kernel),
          form_(form),
          prefix_(prefix),
          declarations_(declarations),
          memory_(memory),
          names_(node_names(kernel)) {
        for (auto& [id, name] : names_) name = prefix_ + name;
        note_scaled_products();
    }

    std::string print() {
        std::map<int, int> step_of;  // by the element that is stored
        for (const graph::Store& store : kernel_.stores) step_of[store.index] = store.step;
        int step = 0;
        for (const graph::Statement& statement :
             graph::schedule_for_registers(kernel_, form_.has_channels ? 3 : 1)) {
            const Node& node = kernel_.graph[statement.node];
            if (statement.is_store &&
                std::exchange(step, step_of[statement.index]) != step_of[statement.index])
                body_ += memory_.end_step();
            if (statement.is_store)
                body_ += memory_.store(statement.index, operand(statement.node));
            else if (node.op == Op::input)
                body_ += memory_.load(node.array, node.index, operand(statement.node).substr(1));
            else
                print_value(statement.node);
        }
        return body_;
    }

    /// Identifiers of the values that no compiler may contract or reassociate.
    const std::vector<std::string>& fixed_results() const { return fixed_results_; }

  private:
    /// c (a b): a compiler that takes it for (c a) b keeps c a in a register for whatever else c a meets.
    /// (Mesa's does, and holds 50 more registers for rotate_accurate of order 6.) Nothing is lost where a b
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
        return fmt::format("%{}in_{}_{}", prefix_, kernel_.inputs[node.array].name, node.index);
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
        bits("size", node.operands[0], size_mask);
        bits("sign", node.operands[1], sign_mask);
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
    Form form_;
    std::string prefix_;
    Declarations& declarations_;
    Memory& memory_;
    std::map<Id, std::string> names_;
    std::set<Id> negated_;
    std::set<Id> scaled_products_;  ///< products of which a constant's product is made
    std::vector<std::string> fixed_results_;
    std::string body_;
};

/// Storage buffers of the vectors that all invocations turn, one vector an invocation.
class Buffers : public Memory {
  public:
    Buffers(const Kernel& kernel, const Form& form, Declarations& declarations)
        : kernel_(kernel), form_(form), declarations_(declarations) {
        declarations_.unsigned_integer(0);
        declarations_.type("floats", "OpTypeRuntimeArray %float");
        declarations_.type("buffer", "OpTypeStruct %floats");
        declarations_.type("buffer_pointer", "OpTypePointer StorageBuffer %buffer");
        declarations_.type("element", "OpTypePointer StorageBuffer %float");
        for (const graph::Array& array : kernel_.inputs) add(array, array.kind == Kind::rotation ? 0 : 1);
        add(kernel_.output, 2);
    }

    /// Names of the buffers and their bindings.
    const std::map<std::string, int>& bindings() const { return bindings_; }
    std::string output() const { return fmt::format("out_{}", kernel_.output.name); }

    /// Where the invocation's vectors begin.
    std::string offsets() {
        std::string text;
        const auto offset = [&](const graph::Array& array, const std::string& name) {
            const std::string size = declarations_.unsigned_integer(array.size * channels(array.kind));
            text += fmt::format("%{}_at = OpIMul %uint %vector {}\n", name, size);
        };
        for (const graph::Array& array : kernel_.inputs) offset(array, fmt::format("in_{}", array.name));
        offset(kernel_.output, output());
        return text;
    }

    std::string load(int input, int index, const std::string& name) override {
        const graph::Array& array = kernel_.inputs[input];
        const std::string buffer = fmt::format("in_{}", array.name);
        if (channels(array.kind) == 1)
            return access(buffer, index, name + "_at") +
                   fmt::format("%{0} = OpLoad %float %{0}_at_p\n", name);
        std::string text, parts;
        for (int c = 0; c < 3; ++c) {
            const std::string part = fmt::format("{}_{}", name, "rgb"[c]);
            text += access(buffer, 3 * index + c, part + "_at") +
                    fmt::format("%{0} = OpLoad %float %{0}_at_p\n", part);
            parts += fmt::format(" %{}", part);
        }
        declarations_.type("rgb", "OpTypeVector %float 3");
        return text + fmt::format("%{} = OpCompositeConstruct %rgb{}\n", name, parts);
    }

    std::string store(int index, const std::string& value) override {
        const std::string place = fmt::format("{}_{}", output(), index);
        if (channels(kernel_.output.kind) == 1)
            return access(output(), index, place) + fmt::format("OpStore %{}_p {}\n", place, value);
        std::string text;
        for (int c = 0; c < 3; ++c) {
            const std::string part = fmt::format("{}_{}", place, "rgb"[c]);
            text += access(output(), 3 * index + c, part) +
                    fmt::format("%{0}_v = OpCompositeExtract %float {1} {2}\nOpStore %{0}_p %{0}_v\n", part,
                                value, c);
        }
        return text;
    }

    /// Compilers join stores of neighbours, and the first waits for the last. (Mesa's holds 100 registers
    /// more for blocks of order 6.) Not across a barrier, and one among invocations that run together is no
    /// instruction there.
    std::string end_step() override {
        constexpr unsigned kSubgroup = 3, kAcquireRelease = 0x8, kUniformMemory = 0x40;
        const std::string scope = declarations_.unsigned_integer(kSubgroup);
        const std::string semantics = declarations_.unsigned_integer(kAcquireRelease | kUniformMemory);
        return fmt::format("OpMemoryBarrier {} {}\n", scope, semantics);
    }

  private:
    int channels(Kind kind) const { return form_.has_channels && kind == Kind::signal ? 3 : 1; }

    void add(const graph::Array& array, int binding) {
        const std::string name = (binding == 2 ? "out_" : "in_") + array.name;
        declarations_.type(name, "OpVariable %buffer_pointer StorageBuffer");
        bindings_[name] = binding;
    }

    /// %NAME_p: the pointer to an element of the invocation's vector.
    std::string access(const std::string& buffer, int index, const std::string& name) {
        const std::string constant = declarations_.unsigned_integer(index);
        return fmt::format(
            "%{0} = OpIAdd %uint %{1}_at {2}\n%{0}_p = OpAccessChain %element %{1} %uint_0 %{0}\n", name,
            buffer, constant);
    }

    const Kernel& kernel_;
    Form form_;
    Declarations& declarations_;
    std::map<std::string, int> bindings_;
};

/// Pointers to arrays of the caller.
class Parameters : public Memory {
  public:
    Parameters(const Kernel& kernel, const Form& form, Declarations& declarations)
        : kernel_(kernel), form_(form), declarations_(declarations) {}

    /// The function's type and its parameters.
    std::string function_type() {
        std::string arguments, name = "function";
        for (const graph::Array* array : arrays()) {
            arguments += fmt::format(" {}", pointer_to(*array));
            name += pointer_to(*array).substr(1);
        }
        return declarations_.type(name, "OpTypeFunction %void" + arguments);
    }
    std::string parameters(const std::string& prefix) {
        prefix_ = prefix;
        std::string text;
        for (const graph::Array* array : arrays())
            text += fmt::format("%{}{} = OpFunctionParameter {}\n", prefix_, array->name, pointer_to(*array));
        return text;
    }

    std::string load(int input, int index, const std::string& name) override {
        const graph::Array& array = kernel_.inputs[input];
        return access(array, index, name + "_p") +
               fmt::format("%{0} = OpLoad {1} %{0}_p\n", name, element_of(array));
    }
    std::string store(int index, const std::string& value) override {
        const std::string place = fmt::format("{}out{}_p", prefix_, index);
        return access(kernel_.output, index, place) + fmt::format("OpStore %{} {}\n", place, value);
    }

    std::string end_step() override { return {}; }

  private:
    std::vector<const graph::Array*> arrays() const {
        std::vector<const graph::Array*> all;
        for (const graph::Array& array : kernel_.inputs) all.push_back(&array);
        all.push_back(&kernel_.output);
        return all;
    }
    std::string element_of(const graph::Array& array) {
        if (!form_.has_channels || array.kind != Kind::signal) return "%float";
        return declarations_.type("rgb", "OpTypeVector %float 3");
    }
    std::string pointer_to(const graph::Array& array) {
        const std::string element = element_of(array), size = declarations_.unsigned_integer(array.size);
        const std::string name = fmt::format("{}s{}", element.substr(1), array.size);
        declarations_.type(name, fmt::format("OpTypeArray {} {}", element, size));
        return declarations_.type(name + "_pointer", fmt::format("OpTypePointer Function %{}", name));
    }
    std::string access(const graph::Array& array, int index, const std::string& name) {
        const std::string element = element_of(array), constant = declarations_.unsigned_integer(index);
        const std::string pointer = declarations_.type(element.substr(1) + "_pointer",
                                                       fmt::format("OpTypePointer Function {}", element));
        return fmt::format("%{} = OpAccessChain {} %{}{} {}\n", name, pointer, prefix_, array.name, constant);
    }

    const Kernel& kernel_;
    Form form_;
    Declarations& declarations_;
    std::string prefix_;
};

std::string comment(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines) text += fmt::format("; {}\n", line);
    return text;
}

/// The banner of a file that holds one kernel.
std::string banner_of(const Unit& unit, const Kernel& kernel) {
    Unit one = unit;
    one.kernels = {kernel};
    one.sources = kernel.sources;
    return comment(banner_lines(one)) + ";\n" + comment(purpose_lines(kernel)) +
           comment(precondition_lines(kernel));
}

/// The kernel whose graph a form of this one prints: that for channels, where it has another.
const Kernel& graph_for(const Unit& unit, const Kernel& kernel, const Form& form) {
    if (!form.has_channels || kernel.for_channels.empty()) return kernel;
    for (const Kernel& other : unit.kernels)
        if (other.name == kernel.for_channels && other.variant == kernel.variant) return other;
    throw std::logic_error("no kernel " + kernel.for_channels);
}

/// Whether another kernel takes this one where a signal value holds channels: it is printed as that one's
/// form.
bool is_for_channels(const Unit& unit, const Kernel& kernel) {
    return std::ranges::any_of(unit.kernels, [&](const Kernel& other) {
        return other.for_channels == kernel.name && other.variant == kernel.variant;
    });
}

/// Whether output may be written over the input signal.
bool turns_in_place(const Kernel& kernel) {
    const graph::Array& input = kernel.inputs.back();
    return input.kind == Kind::signal && kernel.output.kind == Kind::signal &&
           input.size == kernel.output.size;
}

std::string print_compute(const Kernel& kernel, const Form& form) {
    Declarations declarations;
    declarations.type("action", "OpTypeFunction %void");
    declarations.type("bool", "OpTypeBool");
    declarations.unsigned_integer(0);
    declarations.unsigned_integer(1);
    declarations.type("uvec3", "OpTypeVector %uint 3");
    declarations.type("workgroup_x", fmt::format("OpSpecConstant %uint {}", kWorkgroupSize));
    declarations.type("workgroup", "OpSpecConstantComposite %uvec3 %workgroup_x %uint_1 %uint_1");
    declarations.type("uvec3_input", "OpTypePointer Input %uvec3");
    declarations.type("invocation", "OpVariable %uvec3_input Input");
    declarations.type("push_constants", "OpTypeStruct %uint");
    declarations.type("push_constants_pointer", "OpTypePointer PushConstant %push_constants");
    declarations.type("uint_constant", "OpTypePointer PushConstant %uint");
    declarations.type("vectors", "OpVariable %push_constants_pointer PushConstant");
    Buffers buffers(kernel, form, declarations);
    BodyPrinter printer(kernel, form, "", declarations, buffers);
    const std::string offsets = buffers.offsets();
    const std::string body = printer.print();

    std::string text =
        "OpCapability Shader\n"
        "%glsl = OpExtInstImport \"GLSL.std.450\"\n"
        "OpMemoryModel Logical GLSL450\n"
        "OpEntryPoint GLCompute %main \"main\" %invocation\n"
        "OpDecorate %workgroup_x SpecId 0\n"
        "OpDecorate %workgroup BuiltIn WorkgroupSize\n"
        "OpDecorate %invocation BuiltIn GlobalInvocationId\n"
        "OpDecorate %push_constants Block\n"
        "OpMemberDecorate %push_constants 0 Offset 0\n"
        "OpDecorate %floats ArrayStride 4\n"
        "OpDecorate %buffer Block\n"
        "OpMemberDecorate %buffer 0 Offset 0\n";
    for (const auto& [name, binding] : buffers.bindings()) {
        text += fmt::format("OpDecorate %{0} DescriptorSet 0\nOpDecorate %{0} Binding {1}\n", name, binding);
        if (binding != 2) text += fmt::format("OpDecorate %{} NonWritable\n", name);
        // Input and output may be one buffer. (Mesa makes the same code of it.)
        if (binding != 0 && turns_in_place(kernel)) text += fmt::format("OpDecorate %{} Aliased\n", name);
    }
    for (const std::string& name : printer.fixed_results())
        text += fmt::format("OpDecorate %{} NoContraction\n", name);
    return text + declarations.text() +
           "%main = OpFunction %void None %action\n"
           "%entry = OpLabel\n"
           "%invocation_id = OpLoad %uvec3 %invocation\n"
           "%vector = OpCompositeExtract %uint %invocation_id 0\n"
           "%count_p = OpAccessChain %uint_constant %vectors %uint_0\n"
           "%count = OpLoad %uint %count_p\n"
           "%is_vector = OpULessThan %bool %vector %count\n"
           "OpSelectionMerge %end None\n"
           "OpBranchConditional %is_vector %work %end\n"
           "%work = OpLabel\n" +
           offsets + body +
           "OpBranch %end\n"
           "%end = OpLabel\n"
           "OpReturn\n"
           "OpFunctionEnd\n";
}

/// All kernels as functions zonal_orderN_KERNEL and zonal_orderN_KERNEL_rgb on pointers to arrays.
std::string print_functions(const Unit& unit) {
    Declarations declarations;
    std::string exports, functions;
    int count = 0;
    const auto add = [&](const Kernel& kernel, const Form& form) {
        const std::string name =
            fmt::format("zonal_{}_{}{}", unit.name, plain_name(kernel), form.has_channels ? "_rgb" : "");
        const std::string prefix = fmt::format("k{}_", ++count);
        const Kernel& printed = graph_for(unit, kernel, form);
        Parameters parameters(printed, form, declarations);
        const std::string type = parameters.function_type();
        exports += fmt::format("OpDecorate %{0} LinkageAttributes \"{0}\" Export\n", name);
        functions += fmt::format("%{0} = OpFunction %void None {1}\n", name, type) +
                     parameters.parameters(prefix + "in_") + fmt::format("%{}entry = OpLabel\n", prefix);
        functions += BodyPrinter(printed, form, prefix, declarations, parameters).print() +
                     "OpReturn\nOpFunctionEnd\n";
    };
    for (const Kernel& kernel : unit.kernels) {
        if (is_for_channels(unit, kernel)) continue;
        add(kernel, {});
        if (kernel.uses(Kind::signal)) add(kernel, {.has_channels = true});
    }
    return "OpCapability Shader\n"
           "OpCapability Linkage\n"
           "%glsl = OpExtInstImport \"GLSL.std.450\"\n"
           "OpMemoryModel Logical GLSL450\n" +
           exports + declarations.text() + functions;
}

}  // namespace

std::vector<SpirvModule> print_spirv(const Unit& unit) {
    std::vector<SpirvModule> modules;
    const auto add = [&](const std::string& name, const std::string& text, SpirvUse use) {
        modules.push_back({{unit.file_stem + name + ".spvasm", text}, use});
    };
    const auto add_compute = [&](const Kernel& kernel, const std::string& suffix, const Form& form) {
        const Kernel& printed = graph_for(unit, kernel, form);
        add(fmt::format("_{}{}", plain_name(kernel), suffix),
            banner_of(unit, printed) + print_compute(printed, form), SpirvUse::vulkan_1_1);
    };
    add("", comment(banner_lines(unit)) + print_functions(unit), SpirvUse::linkage);
    for (const Kernel& kernel : unit.kernels) {
        if (is_for_channels(unit, kernel)) continue;
        add_compute(kernel, "", {});
        add_compute(kernel, "_precise", {.is_precise = true});
        if (kernel.uses(Kind::signal)) add_compute(kernel, "_rgb", {.has_channels = true});
    }
    return modules;
}

}  // namespace zonal::emit
