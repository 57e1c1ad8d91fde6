// Kernels as functions with linkage, on arrays of the caller.
#include "emit/spirv_linkage.hpp"

#include <fmt/format.h>

namespace zonal::emit {

namespace {

using graph::Kernel;
using graph::Kind;

/// Pointers to arrays of the caller.
class Parameters : public SpirvMemory {
  public:
    Parameters(const Kernel& kernel, const SpirvForm& form, SpirvDeclarations& declarations)
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
    SpirvForm form_;
    SpirvDeclarations& declarations_;
    std::string prefix_;
};

}  // namespace

std::string print_spirv_functions(const std::vector<SpirvFunction>& functions) {
    SpirvDeclarations declarations;
    std::string exports, bodies;
    int count = 0;
    for (const auto& [name, kernel, form] : functions) {
        const std::string prefix = fmt::format("k{}_", ++count);
        Parameters parameters(*kernel, form, declarations);
        const std::string type = parameters.function_type();
        exports += fmt::format("OpDecorate %{0} LinkageAttributes \"{0}\" Export\n", name);
        bodies += fmt::format("%{0} = OpFunction %void None {1}\n", name, type) +
                  parameters.parameters(prefix + "in_") + fmt::format("%{}entry = OpLabel\n", prefix);
        bodies += print_spirv_body(*kernel, form, prefix, declarations, parameters).text +
                  "OpReturn\nOpFunctionEnd\n";
    }
    return "OpCapability Shader\n"
           "OpCapability Linkage\n"
           "%glsl = OpExtInstImport \"GLSL.std.450\"\n"
           "OpMemoryModel Logical GLSL450\n" +
           exports + declarations.text() + bodies;
}

}  // namespace zonal::emit
