// The modules of a unit: which kernels, in which forms, under which names and banners.
#include "emit/spirv.hpp"

#include <fmt/format.h>

#include "emit/spirv_compute.hpp"
#include "emit/text.hpp"

namespace zonal::emit {

namespace {

using graph::Kernel;

/// The comment in front of a module. `name`: under which it is emitted; `kernel`: whose graph it holds.
std::string opening(const Unit& unit, const std::string& name, Kernel kernel, const SpirvForm& form) {
    kernel.has_bound &= !form.is_precise;  // bounds are those of fused instructions
    const bool is_twin = form.is_precise || form.has_channels;
    const std::string command = unit.command(name) + (is_twin ? " --twins" : "");
    std::string text = comment(";", banner_lines(unit, kernel, command)) + ";\n" +
                       comment(";", purpose_lines(kernel)) + comment(";", precondition_lines(kernel));
    if (form.is_precise)
        text += comment(";", {"Never contracted: a product and a sum for each fma of the cost. The bits are "
                              "those of the C++",
                              "kernel compiled with ZONAL_NO_FMA and -ffp-contract=off."});
    return text;
}

}  // namespace

std::vector<File> print_spirv(const Unit& unit, bool has_twins) {
    std::vector<File> modules;
    for (const Kernel& kernel : shader_kernels(unit)) {
        const std::string name = plain_name(kernel);
        const auto add = [&](const char* suffix, const Kernel& body, const SpirvForm& form) {
            modules.push_back({fmt::format("{}/{}{}.spvasm", unit.folder, name, suffix),
                               opening(unit, name, body, form) + print_spirv_compute(body, form)});
        };
        add("", kernel, {});
        if (!has_twins) continue;
        add("_precise", kernel, {.is_precise = true});
        if (kernel.uses(graph::Kind::signal)) add("_rgb", for_channels(unit, kernel), {.has_channels = true});
    }
    return modules;
}

}  // namespace zonal::emit
