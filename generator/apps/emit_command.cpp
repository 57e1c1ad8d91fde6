#include "apps/emit_command.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string_view>

#include "apps/emit_jobs.hpp"
#include "bounds/chosen_rotate.hpp"
#include "bounds/published.hpp"
#include "emit/cpp.hpp"
#include "emit/dialects.hpp"
#include "emit/file.hpp"
#include "emit/js.hpp"
#include "emit/spirv.hpp"
#include "emit/spirv_tools.hpp"
#include "emit/text.hpp"
#include "emit/wgsl.hpp"
#include "io/output_file.hpp"
#include "io/user_error.hpp"
#include "kernels/glsl_tailored.hpp"
#include "kernels/lobes.hpp"
#include "kernels/order_kernels.hpp"
#include "kernels/rotate_choice.hpp"
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
    std::string kernels;
    std::string out;
    bool has_twins = false;
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
    for (emit::File& module : emit::print_spirv(unit, options.has_twins)) {
        if (options.is_optimized) module.content = emit::optimize_spirv(module.content);
        const std::vector<std::uint32_t> words = emit::assemble(module.content);
        files.push_back(module);
        if (options.is_binary)
            files.push_back({fs::path(module.path).replace_extension(".spv").string(), as_bytes(words)});
    }
    return files;
}

Files glsl_files(const emit::Unit& unit, const OrderKernels& order) {
    Files files = emit::print_shader_functions(unit, emit::kGlsl);
    if (order.tables.shared && unit.wants(kernels::kTailoredName))
        files.push_back(
            kernels::print_glsl_tailored(unit, kernels::LobeSet::shared(order.tables.shared->table)));
    return files;
}

/// What writes a language, and how its code computes.
struct Language {
    emit::Arithmetic arithmetic;
    std::function<Files(const emit::Unit&, const OrderKernels&, const EmitOptions&)> print;
};

/// Adding a language is one entry here.
const std::map<std::string, Language>& languages() {
    using enum emit::Arithmetic;
    static const std::map<std::string, Language> all{
        {"cpp",
         {cpp, [](const emit::Unit& unit, const OrderKernels&,
                  const EmitOptions&) { return emit::print_cpp(unit); }}},
        {"glsl",
         {shader, [](const emit::Unit& unit, const OrderKernels& order,
                     const EmitOptions&) { return glsl_files(unit, order); }}},
        {"hlsl",
         {shader, [](const emit::Unit& unit, const OrderKernels&,
                     const EmitOptions&) { return emit::print_shader_functions(unit, emit::kHlsl); }}},
        {"js",
         {javascript, [](const emit::Unit& unit, const OrderKernels&,
                         const EmitOptions&) { return emit::print_js(unit); }}},
        {"spirv",
         {shader, [](const emit::Unit& unit, const OrderKernels&,
                     const EmitOptions& options) { return spirv_files(unit, options); }}},
        {"wgsl",
         {shader, [](const emit::Unit& unit, const OrderKernels&,
                     const EmitOptions&) { return emit::print_wgsl(unit); }}},
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

/// The tables that a kernel is made of.
std::vector<TablePointer> tables_of(const graph::Kernel& kernel, const OrderTables& tables) {
    if (kernel.variant == "per_band") return tables.per_band;
    if (!kernel.needs_lobes) return {};
    return {kernel.name == "rotate_zhf" ? tables.rotate_zhf : tables.shared};
}

/// Puts `rotate` in front: what the processor of the language does fastest within bounds.
void add_rotate(emit::Unit& unit, const OrderKernels& order) {
    using enum kernels::Processor;
    const kernels::Processor processor = unit.arithmetic == emit::Arithmetic::shader ? gpu : cpu;
    const kernels::RotateChoice choice = chosen_rotate(order, unit.bounds, processor);
    unit.kernels.insert(unit.kernels.begin(), kernels::make_rotate(order.kernels, choice));
    unit.bounds["rotate"] = unit.bounds.at(choice.one);
}

/// All but the command.
emit::Unit make_unit(const OrderKernels& order, emit::Arithmetic arithmetic, const EmitOptions& options) {
    emit::Unit unit;
    unit.name = fmt::format("order{}", order.order);
    unit.folder = fmt::format("order{:02}", order.order);
    unit.basis = "real, orthonormal, index l(l+1)+m, no Condon-Shortley sign, z polar";
    unit.kernels = order.kernels;
    if (!options.kernels.empty())
        for (const std::string& name : split(options.kernels, ',')) unit.wanted.insert(name);
    for (const graph::Kernel& kernel : unit.kernels)
        for (const TablePointer& source : tables_of(kernel, order.tables))
            unit.tables[kernel.full_name()].push_back(
                fmt::format("{}  sha256:{}", source->name, source->table.short_hash()));
    unit.arithmetic = arithmetic;
    unit.bounds = published_bounds(order);
    const auto has = [&](const auto& is_wanted) {
        return std::ranges::any_of(unit.kernels, is_wanted) ? 1 : 0;
    };
    add_rotate(unit, order);
    const graph::Kernel& prepare = graph::kernel_named(order.kernels, "prepare");
    const bool takes_mirrors = !unit.kernels.front().needs_proper_rotation && !prepare.needs_proper_rotation;
    unit.constants = {
        {"kHasLobes", order.tables.shared ? 1 : 0, "1 where the lobe kernels are here, else 0"},
        {"kHasPerBandLobes", has([](const graph::Kernel& kernel) { return kernel.variant == "per_band"; }),
         "1 where lobes of each band's own are here, else 0"},
        {"kHasTensor", has([](const graph::Kernel& kernel) { return kernel.name == "rotate_tensor"; }),
         "1 where `rotate_tensor` is here: every band can be contracted; else 0"},
        {"kScalars", prepare.output.size, "Values that `prepare` makes"},
        {"kTakesMirrors", takes_mirrors ? 1 : 0, "1 where `rotate` and `prepare` take det R = -1, else 0"}};
    return unit;
}

/// Whether a kernel, by its plain name, is made of the table that --table names.
bool is_made_of_chosen(const OrderKernels& order, const std::string& name) {
    if (!order.tables.chosen) return false;
    const std::string maker = name == kernels::kTailoredName ? "resample" : name;
    return std::ranges::any_of(order.kernels, [&](const graph::Kernel& kernel) {
        const std::vector<TablePointer> tables = tables_of(kernel, order.tables);
        return emit::plain_name(kernel) == maker &&
               std::ranges::find(tables, order.tables.chosen) != tables.end();
    });
}

/// The command that makes a kernel of one language, or all of them, whatever else the run makes: in the
/// folder that is its own, generated/LANGUAGE.
std::string command_of(const EmitOptions& options, const OrderKernels& order, const std::string& language,
                       const std::string& kernel) {
    const bool has_table = kernel.empty() ? order.tables.chosen != nullptr : is_made_of_chosen(order, kernel);
    return fmt::format("zonal-gen emit --order {} --language {}{}{}{}", order.order, language,
                       kernel.empty() ? "" : " --kernels " + kernel,
                       has_table ? " --table " + shell_word(order.tables.chosen->name) : "",
                       options.is_optimized ? " --optimize" : "");
}

/// The kernels that files hold, by plain name.
std::vector<std::string> kernels_of(const emit::Unit& unit, const Files& files) {
    std::vector<std::string> names;
    for (const emit::File& file : files) {
        const fs::path path = file.path;
        if (path.parent_path().filename() == unit.folder) names.push_back(path.stem().string());
    }
    return names;
}

/// Each name of --kernels is one that the language has.
void check_kernels(emit::Unit unit, const OrderKernels& order, const std::string& language,
                   const Files& files) {
    std::set<std::string> missing = unit.wanted;
    for (const std::string& name : kernels_of(unit, files)) missing.erase(name);
    if (missing.empty()) return;
    for (const graph::Kernel& kernel : unit.kernels) unit.wanted.insert(emit::plain_name(kernel));
    unit.wanted.insert(kernels::kTailoredName);
    std::string known;
    for (const std::string& name : kernels_of(unit, languages().at(language).print(unit, order, {})))
        known += (known.empty() ? "" : ", ") + name;
    throw UserError(fmt::format("--kernels: found '{}', wanted some of what {} has in {}: {}",
                                *missing.begin(), unit.name, language, known));
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
    bool has_spirv = false;
    for (const auto& [order, names] : jobs) {
        has_spirv = has_spirv || std::ranges::find(names, "spirv") != names.end();
        for (const std::string& name : names)
            if ((options.is_optimized || options.is_binary) && name != "spirv")
                throw UserError(fmt::format("--optimize, --binary: found with {}, wanted spirv alone", name));
    }
    if (options.has_twins && !has_spirv)
        throw UserError("--twins: found without spirv, whose modules have them; wanted spirv too");
    return jobs;
}

/// The folder of a language: --out itself where --language says which, inside it where there are several.
fs::path folder_of(const EmitOptions& options, const std::string& language) {
    if (!options.language.empty() && !options.out.empty()) return options.out;
    return fs::path(options.out.empty() ? "generated" : options.out) / language;
}

void note_left_out(const emit::Unit& unit, std::vector<std::string>& notices) {
    const std::vector<std::string> left_out = emit::kernels_left_out(unit);
    if (left_out.empty()) return;
    notices.push_back(
        fmt::format("{}: left out, since compilers take long for them: {}; write them by --kernels",
                    unit.name, fmt::join(left_out, ", ")));
}

/// All files are made before the first is written: a mistake leaves none of them behind.
void run(const EmitOptions& options) {
    TableShelf shelf = project_tables();
    Files all;
    std::set<std::string> paths;  // orders share files
    std::vector<std::string> notices;
    bool is_table_used = options.table.empty();
    for (const auto& [number, names] : jobs_of(options)) {
        const OrderKernels order = build_order_kernels(shelf, number, options.table);
        for (const std::string& name : names) {
            const Language& language = languages().at(name);
            emit::Unit unit = make_unit(order, language.arithmetic, options);
            unit.command = [&](const std::string& kernel) {
                return command_of(options, order, name, kernel);
            };
            Files files = language.print(unit, order, options);
            check_kernels(unit, order, name, files);
            if (name == "cpp") note_left_out(unit, notices);
            for (const std::string& kernel : kernels_of(unit, files))
                is_table_used = is_table_used || is_made_of_chosen(order, kernel);
            for (emit::File& file : files) {
                file.path = (folder_of(options, name) / file.path).string();
                if (paths.insert(file.path).second) all.push_back(std::move(file));
            }
        }
    }
    if (!is_table_used)
        throw UserError(
            fmt::format("--table: found {}, of which no kernel that would be written is made; "
                        "wanted kernels of lobes too, such as resample of C++, or no table",
                        options.table));
    for (const std::string& notice : notices) fmt::print(stderr, "{}\n", notice);
    for (const emit::File& file : all) {
        write_file_atomically(file.path, file.content);
        fmt::print("{}\n", program::shown_on_stdout(file.path));
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
    language->add_option("--language", options->language, "cpp, glsl, hlsl, js, spirv or wgsl")
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
    command
        ->add_option(
            "--kernels", options->kernels,
            "these kernels only, such as rotate,blocks, and what they call (default: all that compile in "
            "seconds)")
        ->check(program::not_empty());
    command->add_flag(
        "--twins", options->has_twins,
        "spirv: beside each module one of three channels (_rgb) and one whose arithmetic is never "
        "contracted (_precise)");
    command->add_flag("--optimize", options->is_optimized, "spirv: run SPIRV-Tools' passes for performance");
    command->add_flag("--binary", options->is_binary, "spirv: write assembled modules (.spv) as well");
    command->callback([options] {
        if (!options->language.empty() && !options->order && !options->orders)
            throw UserError("--language: found no order, wanted --order N or --orders 3-6,8");
        run(*options);
    });
}

}  // namespace zonal
