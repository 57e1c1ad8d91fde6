// Prints expression graphs as functions of shader languages: one statement a value.
#include "emit/shader_functions.hpp"

#include <fmt/format.h>

#include <cctype>

#include "emit/straight_line.hpp"
#include "emit/text.hpp"

namespace zonal::emit {

namespace {

using graph::Kernel;
using graph::Kind;

class ShaderSyntax : public Syntax {
  public:
    ShaderSyntax(const ShaderDialect& dialect, bool has_channels)
        : dialect_(dialect), has_channels_(has_channels) {}

    const std::string& type_of(Kind kind) const {
        return has_channels_ && kind == Kind::signal ? dialect_.vector : dialect_.scalar;
    }
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
        return fmt::format("{0}({1}({2}) | ({1}({3}) & 0x80000000u))", dialect_.from_bits, dialect_.to_bits,
                           float_literal(size_in_float), sign);
    }

  private:
    const ShaderDialect& dialect_;
    bool has_channels_;
};

/// `out` is a word of the languages.
Kernel with_allowed_names(Kernel kernel) {
    if (kernel.output.name == "out") kernel.output.name = "o";
    return kernel;
}

std::string print_function(const Unit& unit, const Kernel& kernel, const ShaderDialect& dialect,
                           bool has_channels) {
    const ShaderSyntax syntax(dialect, has_channels);
    std::string parameters;
    for (const graph::Array& array : kernel.inputs)
        parameters += fmt::format("{} {}[{}], ", syntax.type_of(array.kind), array.name, array.size);
    return fmt::format("void zonal_{}_{}({}out {} {}[{}]) {{\n{}}}\n", unit.name, plain_name(kernel),
                       parameters, syntax.type_of(kernel.output.kind), kernel.output.name, kernel.output.size,
                       print_shader_statements(has_channels ? for_channels(unit, kernel) : kernel, dialect,
                                               has_channels, 4));
}

}  // namespace

std::string print_shader_statements(const Kernel& kernel, const ShaderDialect& dialect, bool has_channels,
                                    int indentation) {
    return print_statements(with_allowed_names(kernel), ShaderSyntax(dialect, has_channels), indentation);
}

std::string print_shader_kernel(const Unit& unit, const Kernel& original, const ShaderDialect& dialect) {
    const Kernel kernel = with_allowed_names(original);
    std::string text = shader_comment(unit, kernel) + print_function(unit, kernel, dialect, false);
    if (kernel.uses(Kind::signal)) text += print_function(unit, kernel, dialect, true);
    return shader_once(fmt::format("{}_{}", unit.name, plain_name(kernel)), text);
}

std::string shader_once(const std::string& name, const std::string& text) {
    std::string guard = "ZONAL_";
    for (const char c : name) guard += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return fmt::format("\n#ifndef {0}\n#define {0}\n{1}#endif\n", guard, text);
}

std::vector<File> print_shader_functions(const Unit& unit, const ShaderDialect& dialect) {
    std::vector<File> files;
    for (const Kernel& kernel : shader_kernels(unit))
        files.push_back(
            {fmt::format("{}/{}.{}", unit.folder, plain_name(kernel), dialect.ending),
             comment("//", banner_lines(unit, kernel)) + print_shader_kernel(unit, kernel, dialect)});
    return files;
}

}  // namespace zonal::emit
