// The module of functions: a compute module that only imports one of them is joined with it by spirv-link and
// gives the results of C++.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "gpu/emitted_shaders.hpp"
#include "gpu/vectors.hpp"

namespace zonal::gpu {
namespace {

/// Instructions that copy arrays between a vector's place in buffers and variables of a function.
class Caller {
  public:
    /// `channels`: 1, or 3 for the function whose signal values are vectors.
    Caller(int order, const ReferenceKernel& kernel, int channels)
        : name_(fmt::format("zonal_order{}_{}{}", order, kernel.name, channels == 3 ? "_rgb" : "")),
          call_(fmt::format("%called = OpFunctionCall %void %{}", name_)) {
        if (kernel.rotation_size > 0) add("rotations", 0, kernel.rotation_size, 1, true);
        if (kernel.has_signal()) add("inputs", 1, kernel.input_size, channels, true);
        add("outputs", 2, kernel.output_size, channels, false);
    }

    std::string text() const {
        return fmt::format(
            R"(OpCapability Shader
OpCapability Linkage
OpMemoryModel Logical GLSL450
OpEntryPoint GLCompute %main "main" %invocation
OpDecorate %{0} LinkageAttributes "{0}" Import
OpDecorate %workgroup_x SpecId 0
OpDecorate %workgroup BuiltIn WorkgroupSize
OpDecorate %invocation BuiltIn GlobalInvocationId
OpDecorate %push Block
OpMemberDecorate %push 0 Offset 0
OpDecorate %floats ArrayStride 4
OpDecorate %buffer Block
OpMemberDecorate %buffer 0 Offset 0
{1}%void = OpTypeVoid
%float = OpTypeFloat 32
%bool = OpTypeBool
%uint = OpTypeInt 32 0
%uint_0 = OpConstant %uint 0
%uint_1 = OpConstant %uint 1
%uvec3 = OpTypeVector %uint 3
%workgroup_x = OpSpecConstant %uint 64
%workgroup = OpSpecConstantComposite %uvec3 %workgroup_x %uint_1 %uint_1
%uvec3_input = OpTypePointer Input %uvec3
%invocation = OpVariable %uvec3_input Input
%push = OpTypeStruct %uint
%push_pointer = OpTypePointer PushConstant %push
%push_uint = OpTypePointer PushConstant %uint
%vectors = OpVariable %push_pointer PushConstant
%floats = OpTypeRuntimeArray %float
%buffer = OpTypeStruct %floats
%buffer_pointer = OpTypePointer StorageBuffer %buffer
%element = OpTypePointer StorageBuffer %float
%local = OpTypePointer Function %float
%rgb = OpTypeVector %float 3
{2}%action = OpTypeFunction %void
%function = OpTypeFunction %void{3}
%{0} = OpFunction %void None %function
{4}OpFunctionEnd
%main = OpFunction %void None %action
%entry = OpLabel
{5}%id = OpLoad %uvec3 %invocation
%vector = OpCompositeExtract %uint %id 0
%count_p = OpAccessChain %push_uint %vectors %uint_0
%count = OpLoad %uint %count_p
%is_vector = OpULessThan %bool %vector %count
OpSelectionMerge %end None
OpBranchConditional %is_vector %work %end
%work = OpLabel
{6}{7}
{8}OpBranch %end
%end = OpLabel
OpReturn
OpFunctionEnd
)",
            name_, decorations_, types_, pointers_, parameters_, variables_, loads_, call_, stores_);
    }

  private:
    void add(const std::string& array, int binding, int size, int channels, bool is_input) {
        const std::string value = channels == 3 ? "rgb" : "float";
        const std::string type = fmt::format("{}s_{}", value, size);
        decorations_ +=
            fmt::format("OpDecorate %{0} DescriptorSet 0\nOpDecorate %{0} Binding {1}\n", array, binding);
        if (declared_.insert(type).second)
            types_ +=
                fmt::format("{0}%{1} = OpTypeArray %{2} {3}\n%{1}_pointer = OpTypePointer Function %{1}\n",
                            number_declared(size), type, value, number(size));
        types_ += fmt::format("{}%{} = OpVariable %buffer_pointer StorageBuffer\n",
                              number_declared(size * channels), array);
        pointers_ += fmt::format(" %{}_pointer", type);
        parameters_ += fmt::format("%parameter_{} = OpFunctionParameter %{}_pointer\n", binding, type);
        variables_ += fmt::format("%local_{} = OpVariable %{}_pointer Function\n", array, type);
        call_ += fmt::format(" %local_{}", array);
        std::string& text = is_input ? loads_ : stores_;
        text += fmt::format("%{}_first = OpIMul %uint %vector {}\n", array, number(size * channels));
        for (int i = 0; i < size * channels; ++i) {
            types_ += number_declared(i) + number_declared(i / channels) + number_declared(i % channels);
            const std::string part = channels == 3 ? fmt::format(" {}", number(i % channels)) : "";
            text += fmt::format(
                "%{0}_at = OpIAdd %uint %{1}_first {2}\n"
                "%{0}_b = OpAccessChain %element %{1} %uint_0 %{0}_at\n"
                "%{0}_l = OpAccessChain %local %local_{1} {3}{4}\n"
                "%{0} = OpLoad %float %{0}_{5}\nOpStore %{0}_{6} %{0}\n",
                fmt::format("{}_{}", array, i), array, number(i), number(i / channels), part,
                is_input ? "b" : "l", is_input ? "l" : "b");
        }
    }
    static std::string number(int value) { return fmt::format("%n{}", value); }
    /// The constant's declaration, once.
    std::string number_declared(int value) {
        if (!declared_.insert(number(value)).second) return {};
        return fmt::format("{} = OpConstant %uint {}\n", number(value), value);
    }

    std::string name_, call_, decorations_, types_, pointers_, parameters_, variables_, loads_, stores_;
    std::set<std::string> declared_;  ///< types and numbers
};

class Linkage : public testing::TestWithParam<int> {
  protected:
    void expect_linked_functions_are_right(const Words& functions, const ReferenceKernel& kernel) const {
        const int order = GetParam();
        for (const int channels : {1, 3}) {
            if (channels == 3 && !kernel.has_signal()) continue;
            const Words words = linked({assembled(Caller(order, kernel, channels).text()), functions});
            const ModuleRunner runner(words, channels * kernel.output_size);
            const Vectors vectors = test_vectors(order, kernel, channels);
            EXPECT_EQ(distance(order, kernel, vectors, runner.run(vectors),
                               expected_results(kernel, vectors, channels), channels),
                      "")
                << "order " << order << ", " << kernel.name << ", channels " << channels;
        }
    }
};

TEST_P(Linkage, functions_joined_by_spirv_link_are_within_bounds_of_cpp) {
    const int order = GetParam();
    const Words functions = assembled(read_text(spirv_folder() / (order_stem(order) + ".spvasm")));
    // Order 3 has every kernel there is, and the least to compile.
    if (order > 3) return expect_linked_functions_are_right(functions, reference_kernel(order, "rotate"));
    for (const ReferenceKernel& kernel : reference_kernels(order))
        expect_linked_functions_are_right(functions, kernel);
}

INSTANTIATE_TEST_SUITE_P(orders, Linkage, testing::ValuesIn(reference_orders()),
                         [](const auto& order) { return fmt::format("order_{}", order.param); });

TEST(LinkageErrors, a_function_that_is_not_there_is_refused) {
    const int order = reference_orders().front();
    ReferenceKernel unknown = reference_kernel(order, "rotate");
    unknown.name = "rotate_backwards";
    const Words functions = assembled(read_text(spirv_folder() / (order_stem(order) + ".spvasm")));
    EXPECT_THROW(linked({assembled(Caller(order, unknown, 1).text()), functions}), std::runtime_error);
}

}  // namespace
}  // namespace zonal::gpu
