// Kernels as compute modules: buffers, the entry point, one vector an invocation.
#include "emit/spirv_compute.hpp"

#include <fmt/format.h>

#include <map>

namespace zonal::emit {

namespace {

using graph::Kernel;
using graph::Kind;

/// Vectors a workgroup turns unless SpecId 0 says otherwise.
constexpr int kWorkgroupSize = 64;

/// Storage buffers of the vectors that all invocations turn, one vector an invocation.
class Buffers : public SpirvMemory {
  public:
    Buffers(const Kernel& kernel, const SpirvForm& form, SpirvDeclarations& declarations)
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

    /// Compilers join stores of neighbours, and the first waits for the last. (Mesa's holds 100 registers
    /// more for blocks of order 6.) Where neighbours belong to different steps they must not.
    std::string store(int index, const std::string& value) override {
        const std::string place = fmt::format("{}_{}", output(), index);
        if (channels(kernel_.output.kind) == 1)
            return access(output(), index, place) +
                   fmt::format("OpStore %{}_p {}{}\n", place, value, kernel_.has_steps() ? " Volatile" : "");
        std::string text;
        for (int c = 0; c < 3; ++c) {
            const std::string part = fmt::format("{}_{}", place, "rgb"[c]);
            text += access(output(), 3 * index + c, part) +
                    fmt::format("%{0}_v = OpCompositeExtract %float {1} {2}\nOpStore %{0}_p %{0}_v\n", part,
                                value, c);
        }
        return text;
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
    SpirvForm form_;
    SpirvDeclarations& declarations_;
    std::map<std::string, int> bindings_;
};

/// Whether output may be written over the input signal.
bool turns_in_place(const Kernel& kernel) {
    const graph::Array& input = kernel.inputs.back();
    return input.kind == Kind::signal && kernel.output.kind == Kind::signal &&
           input.size == kernel.output.size;
}

}  // namespace

std::string print_spirv_compute(const Kernel& kernel, const SpirvForm& form) {
    SpirvDeclarations declarations;
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
    const std::string offsets = buffers.offsets();
    const SpirvBody body = print_spirv_body(kernel, form, declarations, buffers);

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
    for (const std::string& name : body.fixed_results)
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
           offsets + body.text +
           "OpBranch %end\n"
           "%end = OpLabel\n"
           "OpReturn\n"
           "OpFunctionEnd\n";
}

}  // namespace zonal::emit
