// Prints expression graphs as JavaScript: one statement a value. Numbers are doubles, whatever arrays hold.
#include "emit/js.hpp"

#include <fmt/format.h>

#include "emit/straight_line.hpp"
#include "emit/text.hpp"

namespace zonal::emit {

namespace {

using graph::Kernel;
using graph::Kind;

class JsSyntax : public Syntax {
  public:
    /// Element i of an array is `channels` * i behind where a variable says that it begins.
    JsSyntax(std::string input_start, std::string output_start, int channels)
        : input_start_(std::move(input_start)), output_start_(std::move(output_start)), channels_(channels) {}

    std::string declare(Kind, const std::string& name, const std::string& value) const override {
        return fmt::format("const {} = {};", name, value);
    }
    std::string constant(const graph::Number& value) const override { return literal(value); }
    std::string fused(const std::string& a, const std::string& b, const std::string& c) const override {
        return product_and_sum(a, b, c);
    }
    /// Division tells -0 from +0.
    std::string copy_sign(const graph::Number& size, const graph::Number&,
                          const std::string& sign) const override {
        return fmt::format("{0} < 0 || 1 / {0} < 0 ? -{1} : {1}", sign, literal(size));
    }
    std::string square_root(const std::string& a) const override { return fmt::format("Math.sqrt({})", a); }
    std::string element(const graph::Array& array, int index) const override {
        if (array.kind == Kind::rotation) return Syntax::element(array, index);
        return fmt::format("{}[{} + {}]", array.name, array.name == "f" ? input_start_ : output_start_,
                           channels_ * index);
    }

  private:
    std::string input_start_, output_start_;
    int channels_;
};

std::string print_function(const Kernel& kernel) {
    return fmt::format("export function {}(R, f, out, fAt = 0, outAt = 0) {{\n{}}}\n", plain_name(kernel),
                       print_statements(kernel, JsSyntax("fAt", "outAt", 1), 2));
}

/// What depends on R alone, then each channel of each vector.
std::string print_rgb_function(const std::string& name, const Kernel& kernel) {
    const JsSyntax syntax("from", "to", 3);
    const int size = 3 * kernel.output.size;
    return fmt::format(
        "\n"
        "// The same for three channels, interleaved: element i of vector v is f[fAt + {size} * v + 3 * i + "
        "c].\n"
        "// `count` vectors by one R: what depends on R alone is computed once.\n"
        "export function {name}_rgb(R, f, out, fAt = 0, outAt = 0, count = 1) {{\n{scalars}"
        "  for (let v = 0; v < count; ++v) {{\n"
        "    for (let c = 0; c < 3; ++c) {{\n"
        "      const from = fAt + {size} * v + c;\n"
        "      const to = outAt + {size} * v + c;\n"
        "{signals}    }}\n  }}\n}}\n",
        fmt::arg("size", size), fmt::arg("name", name),
        fmt::arg("scalars", print_statements_of(Kind::rotation, kernel, syntax, 2)),
        fmt::arg("signals", print_statements_of(Kind::signal, kernel, syntax, 6)));
}

}  // namespace

std::vector<File> print_js(const Unit& unit) {
    std::vector<File> files;
    for (const Kernel& kernel : shader_kernels(unit)) {
        const std::string name = plain_name(kernel);
        if (name != "rotate" && name != "rotate_accurate") continue;
        files.push_back({fmt::format("{}/{}.mjs", unit.folder, name),
                         comment("//", banner_lines(unit, kernel)) + "\n" + shader_comment(unit, kernel) +
                             "// out may be f, at the same place.\n" + print_function(kernel) +
                             print_rgb_function(name, for_channels(unit, kernel))});
    }
    return files;
}

}  // namespace zonal::emit
