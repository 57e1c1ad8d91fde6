#include "apps/emit_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <memory>

#include "emit/cpp.hpp"
#include "emit/file.hpp"
#include "emit/glsl.hpp"
#include "emit/glsl_tailored.hpp"
#include "emit/spirv.hpp"
#include "emit/wgsl.hpp"
#include "kernels/registry.hpp"
#include "order_kernels.hpp"
#include "output_file.hpp"
#include "user_error.hpp"

namespace zonal {

namespace {

namespace fs = std::filesystem;

struct EmitOptions {
    int order = 0;
    std::string language;
    std::string table;
    std::string out;
    bool is_optimized = false;
    bool is_binary = false;
};

using Files = std::vector<emit::File>;

std::string as_bytes(const std::vector<std::uint32_t>& words) {
    return {reinterpret_cast<const char*>(words.data()), words.size() * sizeof(words[0])};
}

/// Every module is assembled and validated before it is written.
Files spirv_files(const emit::Unit& unit, const EmitOptions& options) {
    Files files;
    for (emit::SpirvModule& module : emit::print_spirv(unit)) {
        if (options.is_optimized) module.file.content = emit::optimize_spirv(module.file.content, module.use);
        const std::vector<std::uint32_t> words = emit::assemble(module.file.content, module.use);
        files.push_back(module.file);
        if (options.is_binary)
            files.push_back({fs::path(module.file.path).replace_extension(".spv").string(), as_bytes(words)});
    }
    return files;
}

/// Bands 0 and 1 are those of an order-2 signal: they turn by its kernel, exactly, and need no table.
emit::TailoredRotation tailored_rotation(const kernels::LobeSet& lobes) {
    constexpr int kLowBands = 2;
    emit::TailoredRotation rotation;
    rotation.rotate_low = graph::kernel_named(kernels::build_order(kLowBands, {}), "rotate");
    rotation.rotate_low.name = "rotate_low";
    rotation.rotate_low.summary = "Rotates bands 0 and 1: f'(w) = f(R^T w).";
    for (int l = kLowBands; l < lobes.order; ++l)
        rotation.bands.push_back({l, lobes.weight_start(l), l * l, 2 * l + 1, lobes.lobes_of[l]});
    return rotation;
}

Files glsl_files(const emit::Unit& unit, const OrderKernels& order) {
    Files files{{unit.file_stem + ".glsl", emit::print_glsl(unit)}};
    if (order.lobes)
        files.push_back({unit.file_stem + "_tailored.glsl",
                         emit::print_glsl_tailored(unit, tailored_rotation(order.lobes->set))});
    return files;
}

using Language = std::function<Files(const emit::Unit&, const OrderKernels&, const EmitOptions&)>;

/// Adding a language is one entry here.
const std::map<std::string, Language>& languages() {
    static const std::map<std::string, Language> all{
        {"cpp",
         [](const emit::Unit& unit, const OrderKernels&, const EmitOptions&) -> Files {
             return {{"zonal/" + unit.file_stem + ".hpp", emit::print_cpp(unit)}};
         }},
        {"glsl", [](const emit::Unit& unit, const OrderKernels& order,
                    const EmitOptions&) { return glsl_files(unit, order); }},
        {"spirv", [](const emit::Unit& unit, const OrderKernels&,
                     const EmitOptions& options) { return spirv_files(unit, options); }},
        {"wgsl",
         [](const emit::Unit& unit, const OrderKernels&, const EmitOptions&) -> Files {
             return {{unit.file_stem + ".wgsl", emit::print_wgsl(unit)}};
         }},
    };
    return all;
}

const Language& find_language(const std::string& name) {
    const auto found = languages().find(name);
    if (found != languages().end()) return found->second;
    std::string known;
    for (const auto& [key, language] : languages()) known += (known.empty() ? "" : ", ") + key;
    throw UserError(fmt::format("--language: found '{}', wanted one of: {}", name, known));
}

std::vector<std::string> tables_of(const OrderKernels& order) {
    if (!order.lobes) return {"none for this order, so no searched lobes: zonal-gen search"};
    const auto describe = [](const NamedTable& source, const char* use = "") {
        return fmt::format("{}  sha256:{}{}", source.name, source.table.short_hash(), use);
    };
    std::vector<std::string> tables{describe(order.lobes->source)};
    if (order.turned) tables.push_back(describe(order.turned->source, ", of rotate_zhf"));
    if (order.band_lobes)
        for (const NamedTable& source : order.band_lobes->sources) tables.push_back(describe(source));
    return tables;
}

emit::Unit make_unit(const EmitOptions& options, const OrderKernels& order) {
    emit::Unit unit;
    unit.name = fmt::format("order{}", options.order);
    unit.file_stem = fmt::format("order{:02}", options.order);
    unit.command =
        fmt::format("zonal-gen emit --order {} --language {}{}{} --out generated/{}", options.order,
                    options.language, options.table.empty() ? "" : " --table " + order.lobes->source.name,
                    options.is_optimized ? " --optimize" : "", options.language);
    unit.tables = tables_of(order);
    unit.basis = "real, orthonormal, index l(l+1)+m, no Condon-Shortley sign, z polar";
    unit.kernels = order.kernels;
    for (const graph::Kernel& kernel : unit.kernels)
        for (const std::string& source : kernel.sources)
            if (std::find(unit.sources.begin(), unit.sources.end(), source) == unit.sources.end())
                unit.sources.push_back(source);
    unit.bounds = order.bounds;
    unit.constants = {{"kHasLobes", order.lobes ? 1 : 0, "1 where the lobe kernels are here, else 0"}};
    const bool has_per_band = std::ranges::any_of(
        unit.kernels, [](const graph::Kernel& kernel) { return kernel.variant == "per_band"; });
    unit.constants.push_back(
        {"kHasPerBandLobes", has_per_band ? 1 : 0, "1 where lobes of each band's own are here, else 0"});
    const bool has_polynomial = std::ranges::any_of(
        unit.kernels, [](const graph::Kernel& kernel) { return kernel.name == "rotate_polynomial"; });
    unit.constants.push_back(
        {"kHasPolynomial", has_polynomial ? 1 : 0,
         "1 where `rotate_polynomial` is here: `rotate` divides and every band can do without; else 0"});
    const graph::Kernel& prepare = graph::kernel_named(order.kernels, "prepare");
    unit.constants.push_back({"kScalars", prepare.output.size, "Values that `prepare` makes"});
    const bool takes_mirrors =
        !graph::kernel_named(order.kernels, "rotate").needs_proper_rotation && !prepare.needs_proper_rotation;
    unit.constants.push_back({"kTakesMirrors", takes_mirrors ? 1 : 0,
                              "1 where `rotate` of one channel and `prepare` take det R = -1, else 0"});
    return unit;
}

void run(const EmitOptions& options) {
    const Language& language = find_language(options.language);
    if ((options.is_optimized || options.is_binary) && options.language != "spirv")
        throw UserError(
            fmt::format("--optimize, --binary: found with --language {}, wanted spirv", options.language));
    const OrderKernels order = build_order_kernels(options.order, options.table);
    const fs::path folder = options.out.empty() ? "generated/" + options.language : options.out;
    for (const emit::File& file : language(make_unit(options, order), order, options)) {
        write_file_atomically(folder / file.path, file.content);
        fmt::print("{}\n", (folder / file.path).string());
    }
}

}  // namespace

void add_emit_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("emit", "write the kernels of an order");
    const auto options = std::make_shared<EmitOptions>();
    command->add_option("--order", options->order, "number of bands")->required();
    command->add_option("--language", options->language, "cpp, glsl, spirv or wgsl")->required();
    command->add_option("--table", options->table, "lobe table (default: generator/tables/orderNN.json)");
    command->add_option("--out", options->out, "folder to write into (default: generated/LANGUAGE)");
    command->add_flag("--optimize", options->is_optimized, "spirv: run SPIRV-Tools' passes for performance");
    command->add_flag("--binary", options->is_binary, "spirv: write assembled modules (.spv) as well");
    command->callback([options] { run(*options); });
}

}  // namespace zonal
