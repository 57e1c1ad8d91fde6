#include "apps/emit_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string_view>

#include "apps/emit_jobs.hpp"
#include "bounds/published.hpp"
#include "emit/cpp.hpp"
#include "emit/file.hpp"
#include "emit/glsl.hpp"
#include "emit/glsl_tailored.hpp"
#include "emit/spirv.hpp"
#include "emit/wgsl.hpp"
#include "io/output_file.hpp"
#include "io/user_error.hpp"
#include "kernels/lobes.hpp"
#include "kernels/order_kernels.hpp"
#include "kernels/registry.hpp"
#include "program/numbers.hpp"
#include "program/program.hpp"
#include "program/shown.hpp"

namespace zonal {

namespace {

namespace fs = std::filesystem;

struct EmitOptions {
    std::optional<int> order;
    std::optional<std::string> orders;
    std::string language;
    std::string languages;
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
    if (order.tables.shared)
        files.push_back({unit.file_stem + "_tailored.glsl",
                         emit::print_glsl_tailored(
                             unit, tailored_rotation(kernels::LobeSet::shared(order.tables.shared->table)))});
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

const Language& find_language(const char* option, const std::string& name) {
    const auto found = languages().find(name);
    if (found != languages().end()) return found->second;
    std::string known;
    for (const auto& [key, language] : languages()) known += (known.empty() ? "" : ", ") + key;
    throw UserError(fmt::format("{}: found '{}', wanted one of: {}", option, name, known));
}

/// A text as one word of a command.
std::string shell_word(const std::string& text) {
    const auto is_plain = [](unsigned char byte) {
        return std::isalnum(byte) != 0 || byte >= 0x80 ||
               std::string_view("_-./+,:=@%").find(static_cast<char>(byte)) != std::string_view::npos;
    };
    if (!text.empty() && std::ranges::all_of(text, is_plain)) return text;
    std::string word = "'";
    for (const char byte : text) word += byte == '\'' ? "'\\''" : std::string(1, byte);
    return word + "'";
}

std::vector<std::string> lines_of(const OrderTables& tables) {
    if (!tables.shared) return {"none for this order, so no searched lobes: zonal-gen search"};
    const auto describe = [](const NamedTable& source, const char* use = "") {
        return fmt::format("{}  sha256:{}{}", source.name, source.table.short_hash(), use);
    };
    std::vector<std::string> lines{describe(*tables.shared)};
    if (tables.has_own_rotate_zhf()) lines.push_back(describe(*tables.rotate_zhf, ", of rotate_zhf"));
    for (const TablePointer& source : tables.per_band) lines.push_back(describe(*source));
    return lines;
}

/// The command that makes one language of an order, whatever else the run makes.
std::string command_of(const EmitOptions& options, const OrderKernels& order, const std::string& language) {
    return fmt::format("zonal-gen emit --order {} --language {}{}{} --out generated/{}", order.order,
                       language,
                       order.tables.chosen ? " --table " + shell_word(order.tables.chosen->name) : "",
                       options.is_optimized ? " --optimize" : "", language);
}

/// All but the command.
emit::Unit make_unit(const OrderKernels& order) {
    emit::Unit unit;
    unit.name = fmt::format("order{}", order.order);
    unit.file_stem = fmt::format("order{:02}", order.order);
    unit.tables = lines_of(order.tables);
    unit.basis = "real, orthonormal, index l(l+1)+m, no Condon-Shortley sign, z polar";
    unit.kernels = order.kernels;
    for (const graph::Kernel& kernel : unit.kernels)
        for (const std::string& source : kernel.sources)
            if (std::find(unit.sources.begin(), unit.sources.end(), source) == unit.sources.end())
                unit.sources.push_back(source);
    unit.bounds = published_bounds(order.order, order.tables, order.kernels);
    unit.constants = {
        {"kHasLobes", order.tables.shared ? 1 : 0, "1 where the lobe kernels are here, else 0"}};
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

EmitJobs jobs_of(const EmitOptions& options) {
    if (!options.language.empty()) find_language("--language", options.language);
    std::set<int> orders;
    if (options.order) {
        orders = {*options.order};
    } else if (options.orders) {
        orders = orders_of("--orders", *options.orders);
    }
    const auto check = [](const std::string& name) { find_language("--languages", name); };
    const EmitJobs jobs =
        emit_jobs(orders, options.language.empty() ? options.languages : options.language, check);
    for (const auto& [order, names] : jobs)
        for (const std::string& name : names)
            if ((options.is_optimized || options.is_binary) && name != "spirv")
                throw UserError(fmt::format("--optimize, --binary: found with {}, wanted spirv alone", name));
    return jobs;
}

/// The folder of a language: --out itself where --language says which, inside it where there are several.
fs::path folder_of(const EmitOptions& options, const std::string& language) {
    if (!options.language.empty() && !options.out.empty()) return options.out;
    return fs::path(options.out.empty() ? "generated" : options.out) / language;
}

void run(const EmitOptions& options) {
    TableShelf shelf = project_tables();
    for (const auto& [number, names] : jobs_of(options)) {
        const OrderKernels order = build_order_kernels(shelf, number, options.table);
        emit::Unit unit = make_unit(order);
        for (const std::string& name : names) {
            unit.command = command_of(options, order, name);
            const fs::path folder = folder_of(options, name);
            for (const emit::File& file : languages().at(name)(unit, order, options)) {
                write_file_atomically(folder / file.path, file.content);
                fmt::print("{}\n", program::shown_on_stdout((folder / file.path).string()));
            }
        }
    }
}

}  // namespace

void add_emit_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("emit", "write the kernels of an order");
    const auto options = std::make_shared<EmitOptions>();
    CLI::Option* order =
        program::add_number(*command, "--order", options->order,
                            program::from_to(kSmallestOrder, kLargestOrder), "number of bands");
    command->add_option("--orders", options->orders, "several orders, such as 3-6,8")->excludes(order);
    CLI::Option_group* language = command->add_option_group("language", "what to write");
    language->add_option("--language", options->language, "cpp, glsl, spirv or wgsl")
        ->check(program::not_empty());
    language->add_option("--languages", options->languages,
                         "several languages, such as cpp,glsl; one may have orders of its own, joined by +: "
                         "cpp:2-10,glsl:3-6+8");
    language->require_option(1);
    command
        ->add_option(
            "--table", options->table,
            "lobe table to take for what its field `for` names (default: those of the folder of tables)")
        ->check(program::not_empty())
        ->needs(order);
    command
        ->add_option("--out", options->out,
                     "folder to write into (default: generated/LANGUAGE); with --languages the folder of "
                     "their folders (default: generated)")
        ->check(program::not_empty());
    command->add_flag("--optimize", options->is_optimized, "spirv: run SPIRV-Tools' passes for performance");
    command->add_flag("--binary", options->is_binary, "spirv: write assembled modules (.spv) as well");
    command->callback([options] {
        if (!options->language.empty() && !options->order && !options->orders)
            throw UserError("--language: found no order, wanted --order N or --orders 3-6,8");
        run(*options);
    });
}

}  // namespace zonal
