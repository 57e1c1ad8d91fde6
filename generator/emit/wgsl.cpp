// Prints expression graphs as WGSL functions: one statement a value.
#include "emit/wgsl.hpp"

#include <fmt/format.h>

#include "emit/straight_line.hpp"
#include "emit/text.hpp"

namespace zonal::emit {

namespace {

using graph::Kernel;
using graph::Kind;

class WgslSyntax : public Syntax {
  public:
    std::string declare(Kind, const std::string& name, const std::string& value) const override {
        return fmt::format("let {} = {};", name, value);
    }
    std::string constant(const graph::Number& value) const override { return float_literal(value); }
    std::string fused(const std::string& a, const std::string& b, const std::string& c) const override {
        return product_and_sum(a, b, c);
    }
    /// By bits: a comparison with 0 would take -0 for +0. Sizes are not negative.
    std::string copy_sign(const graph::Number&, const graph::Number& size_in_float,
                          const std::string& sign) const override {
        return fmt::format("bitcast<f32>(bitcast<u32>({}) | (bitcast<u32>({}) & 0x80000000u))",
                           float_literal(size_in_float), sign);
    }
};

std::string array_type(const graph::Array& array, bool has_channels) {
    const bool is_vector = has_channels && array.kind == Kind::signal;
    return fmt::format("array<{}, {}>", is_vector ? "vec3<f32>" : "f32", array.size);
}

std::string function_name(const Unit& unit, const std::string& kernel, bool has_channels) {
    return fmt::format("zonal_{}_{}{}", unit.name, kernel, has_channels ? "_rgb" : "");
}

std::string print_function(const Unit& unit, const Kernel& kernel, bool has_channels) {
    std::string parameters;
    for (const graph::Array& array : kernel.inputs)
        parameters += fmt::format("{}{}: {}", parameters.empty() ? "" : ", ", array.name,
                                  array_type(array, has_channels));
    const std::string result = array_type(kernel.output, has_channels);
    const std::string head = fmt::format(
        "fn {}({}) -> {} {{\n", function_name(unit, plain_name(kernel), has_channels), parameters, result);
    const Kernel& body = has_channels ? for_channels(unit, kernel) : kernel;
    return head + fmt::format("    var {}: {};\n{}    return {};\n}}\n", kernel.output.name, result,
                              print_statements(body, WgslSyntax(), 4), kernel.output.name);
}

std::string print_kernel(const Unit& unit, const Kernel& kernel) {
    std::string text =
        fmt::format("\n{}{}", shader_comment(unit, kernel), print_function(unit, kernel, false));
    if (kernel.uses(Kind::signal)) text += print_function(unit, kernel, true);
    return text;
}

}  // namespace

std::vector<File> print_wgsl(const Unit& unit) {
    std::vector<File> files;
    for (const Kernel& kernel : shader_kernels(unit))
        files.push_back({fmt::format("{}/{}.wgsl", unit.folder, plain_name(kernel)),
                         comment("//", banner_lines(unit, kernel)) + print_kernel(unit, kernel)});
    return files;
}

}  // namespace zonal::emit
