// Prints expression graphs as GLSL functions: one statement a value.
#include "emit/glsl.hpp"

#include <fmt/format.h>

#include <cctype>

#include "emit/straight_line.hpp"
#include "emit/text.hpp"

namespace zonal::emit {

namespace {

using graph::Kernel;
using graph::Kind;

/// float, or vec3 for signal values of three channels; highp, whatever the shader's default precision is.
class GlslSyntax : public Syntax {
  public:
    explicit GlslSyntax(bool has_channels) : signal_(has_channels ? "highp vec3" : "highp float") {}

    std::string type_of(Kind kind) const { return kind == Kind::signal ? signal_ : "highp float"; }

    std::string declare(Kind kind, const std::string& name, const std::string& value) const override {
        return fmt::format("{} {} = {};", type_of(kind), name, value);
    }
    std::string constant(const graph::Number& value) const override { return float_literal(value); }
    std::string fused(const std::string& a, const std::string& b, const std::string& c) const override {
        return product_and_sum(a, b, c);
    }
    /// By bits: a comparison with 0 would take -0 for +0. Sizes are not negative.
    std::string copy_sign(const graph::Number&, const graph::Number& size_in_float,
                          const std::string& sign) const override {
        return fmt::format("uintBitsToFloat(floatBitsToUint({}) | (floatBitsToUint({}) & 0x80000000u))",
                           float_literal(size_in_float), sign);
    }

  private:
    std::string signal_;
};

/// `out` is a word of the language.
Kernel with_allowed_names(Kernel kernel) {
    if (kernel.output.name == "out") kernel.output.name = "o";
    return kernel;
}

std::string function_name(const Unit& unit, const Kernel& kernel) {
    return fmt::format("zonal_{}_{}", unit.name, plain_name(kernel));
}

std::string signature(const Unit& unit, const Kernel& kernel, const GlslSyntax& syntax) {
    std::string text = fmt::format("void {}(", function_name(unit, kernel));
    for (const graph::Array& array : kernel.inputs)
        text += fmt::format("{} {}[{}], ", syntax.type_of(array.kind), array.name, array.size);
    return text + fmt::format("out {} {}[{}])", syntax.type_of(kernel.output.kind), kernel.output.name,
                              kernel.output.size);
}

std::string print_function(const Unit& unit, const Kernel& kernel, bool has_channels) {
    const GlslSyntax syntax(has_channels);
    const Kernel& body = has_channels ? for_channels(unit, kernel) : kernel;
    return fmt::format("{} {{\n{}}}\n", signature(unit, kernel, syntax),
                       print_glsl_statements(body, has_channels, 4));
}

}  // namespace

std::string print_glsl_statements(const Kernel& kernel, bool has_channels, int indentation) {
    return print_statements(with_allowed_names(kernel), GlslSyntax(has_channels), indentation);
}

std::string print_glsl_kernel(const Unit& unit, const Kernel& original) {
    const Kernel kernel = with_allowed_names(original);
    std::string text = shader_comment(unit, kernel) + print_function(unit, kernel, false);
    if (kernel.uses(Kind::signal)) text += print_function(unit, kernel, true);
    return glsl_once(fmt::format("{}_{}", unit.name, plain_name(kernel)), text);
}

std::string glsl_once(const std::string& name, const std::string& text) {
    std::string guard = "ZONAL_";
    for (const char c : name) guard += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return fmt::format("\n#ifndef {0}\n#define {0}\n{1}#endif\n", guard, text);
}

std::vector<File> print_glsl(const Unit& unit) {
    std::vector<File> files;
    for (const Kernel& kernel : shader_kernels(unit))
        files.push_back({fmt::format("{}/{}.glsl", unit.folder, plain_name(kernel)),
                         comment("//", banner_lines(unit, kernel)) + print_glsl_kernel(unit, kernel)});
    return files;
}

}  // namespace zonal::emit
