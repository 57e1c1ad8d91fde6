// The modules of a unit: which kernels, in which forms, under which names and banners.
#include "emit/spirv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "emit/spirv_compute.hpp"
#include "emit/spirv_linkage.hpp"
#include "emit/text.hpp"

namespace zonal::emit {

namespace {

using graph::Kernel;
using graph::Kind;

/// The banner of a file that holds one form of a kernel.
std::string banner_of(const Unit& unit, const Kernel& kernel, const SpirvForm& form) {
    Unit one{unit.name,      unit.file_stem, unit.command, unit.tables, unit.basis,
             kernel.sources, {kernel},       {},           unit.bounds};
    one.kernels[0].has_bound &= !form.is_precise;  // bounds are those of fused instructions
    const std::string text = comment(";", banner_lines(one)) + ";\n" + comment(";", purpose_lines(kernel)) +
                             comment(";", precondition_lines(kernel));
    if (!form.is_precise) return text;
    return text + comment(";", {"Never contracted: a product and a sum for each fma of the cost. The bits "
                                "are those of the C++",
                                "kernel compiled with ZONAL_NO_FMA and -ffp-contract=off."});
}

/// The kernel whose graph three channels take: another one, where that costs less.
const Kernel& for_channels(const Unit& unit, const Kernel& kernel) {
    if (kernel.for_channels.empty()) return kernel;
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

}  // namespace

std::vector<SpirvModule> print_spirv(const Unit& unit) {
    std::vector<SpirvFunction> functions;
    std::vector<SpirvModule> modules;
    const auto add_compute = [&](const std::string& name, const Kernel& kernel, const SpirvForm& form) {
        modules.push_back({{fmt::format("{}_{}.spvasm", unit.file_stem, name),
                            banner_of(unit, kernel, form) + print_spirv_compute(kernel, form)},
                           SpirvUse::vulkan_1_1});
    };
    const auto add = [&](const std::string& name, const Kernel& kernel, const SpirvForm& form) {
        functions.push_back({fmt::format("zonal_{}_{}", unit.name, name), &kernel, form});
        add_compute(name, kernel, form);
    };
    for (const Kernel& kernel : unit.kernels) {
        if (is_for_channels(unit, kernel)) continue;
        const std::string name = plain_name(kernel);
        add(name, kernel, {});
        add_compute(name + "_precise", kernel, {.is_precise = true});
        if (kernel.uses(Kind::signal)) add(name + "_rgb", for_channels(unit, kernel), {.has_channels = true});
    }
    modules.insert(modules.begin(), {{unit.file_stem + ".spvasm",
                                      comment(";", banner_lines(unit)) + print_spirv_functions(functions)},
                                     SpirvUse::linkage});
    return modules;
}

}  // namespace zonal::emit
