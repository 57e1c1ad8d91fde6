// zonal-gpu-cost: what a compiler for GPUs makes of the shaders, without a GPU. Pipelines are created on the
// null device of Mesa's RADV, and its statistics printed: estimates of that compiler, the same on every run,
// and nothing measured.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>

#include "gpu/pipeline_statistics.hpp"
#include "gpu/shader_modules.hpp"
#include "gpu/tailored_shader.hpp"
#include "program/numbers.hpp"
#include "program/program.hpp"

namespace {

namespace fs = std::filesystem;
using zonal::gpu::Device;
using zonal::gpu::PipelineStatistics;

/// The kernel that is no module of its own: it is compiled from GLSL.
const char* const kTailored = "tailored_rgb";

struct Options {
    std::vector<int> orders;
    std::vector<std::string> kernels, families{"navi21", "vega10"}, modules;
    std::string spirv = ZONAL_GENERATED_SPIRV, glsl = ZONAL_GENERATED_GLSL, json;
};

struct Shader {
    std::string kernel;
    std::optional<int> order;  ///< none for a file of the user
    std::vector<std::uint32_t> words;
};

/// Modules that print a row when nothing is asked for.
std::vector<std::string> usual_kernels() {
    std::vector<std::string> kernels;
    for (const char* kernel :
         {"rotate", "rotate_tensor", "rotate_accurate", "rotate_zhf", "apply", "resample"})
        for (const char* suffix : {"", "_rgb"}) kernels.push_back(std::string(kernel) + suffix);
    kernels.emplace_back("prepare");
    kernels.emplace_back(kTailored);
    return kernels;
}

fs::path file_of(const Options& options, int order, const std::string& kernel) {
    if (kernel == kTailored)
        return fs::path(options.glsl) / fmt::format("order{:02}/rotate_tailored.glsl", order);
    return fs::path(options.spirv) / fmt::format("order{:02}/{}.spvasm", order, kernel);
}

std::vector<std::uint32_t> read_kernel(const Options& options, int order, const std::string& kernel) {
    const fs::path file = file_of(options, order, kernel);
    if (!fs::exists(file))
        throw std::runtime_error(
            fmt::format("{}: not found, wanted kernel {} of order {}; `zonal-gen emit --order {} --language "
                        "{} --twins --out {}` "
                        "writes the kernels that the order has",
                        file.string(), kernel, order, order, kernel == kTailored ? "glsl" : "spirv",
                        file.parent_path().string()));
    if (kernel != kTailored) return zonal::gpu::read_shader(file);
    return zonal::gpu::compiled(zonal::gpu::tailored_compute_shader(order, zonal::gpu::read_text(file)));
}

/// What was asked for, or the usual kernels of the orders that the folder has.
std::vector<Shader> collect(const Options& options) {
    std::vector<int> orders = options.orders;
    constexpr int kHighestOrder = 20;
    if (orders.empty() && options.modules.empty())
        for (int order = 1; order <= kHighestOrder; ++order)
            if (fs::exists(file_of(options, order, "rotate"))) orders.push_back(order);
    std::vector<Shader> shaders;
    for (const int order : orders)
        for (const std::string& kernel : options.kernels.empty() ? usual_kernels() : options.kernels)
            if (!options.kernels.empty() || fs::exists(file_of(options, order, kernel)))
                shaders.push_back({kernel, order, read_kernel(options, order, kernel)});
    for (const std::string& module : options.modules)
        shaders.push_back(
            {fs::path(module).filename().string(), std::nullopt, zonal::gpu::read_shader(module)});
    if (shaders.empty())
        throw std::runtime_error(
            fmt::format("found no shader in {}, wanted orderNN/KERNEL.spvasm; `zonal-gen "
                        "emit --order N --language spirv --twins --out {}` writes them",
                        options.spirv, options.spirv));
    return shaders;
}

nlohmann::ordered_json row_of(const std::string& family, const Shader& shader, const PipelineStatistics& s) {
    nlohmann::ordered_json row{{"family", family}, {"kernel", shader.kernel}};
    if (shader.order) row["order"] = *shader.order;
    row["instructions"] = s.instructions;
    row["vgprs"] = s.vgprs;
    row["sgprs"] = s.sgprs;
    row["spilled_vgprs"] = s.spilled_vgprs;
    row["spilled_sgprs"] = s.spilled_sgprs;
    row["code_bytes"] = s.code_bytes;
    row["waves_per_simd"] = s.waves_per_simd;
    row["latency_cycles"] = s.latency_cycles;
    row["inverse_throughput_cycles"] = s.inverse_throughput;
    return row;
}

void print_row(const Shader& shader, const PipelineStatistics& s) {
    fmt::print("| {:>2} | {:<24} | {:>6} | {:>5} | {:>5} | {:>9} | {:>7} | {:>5} | {:>7} | {:>7} |\n",
               shader.order ? std::to_string(*shader.order) : "", shader.kernel, s.instructions, s.vgprs,
               s.sgprs, fmt::format("{}, {}", s.spilled_vgprs, s.spilled_sgprs), s.code_bytes,
               s.waves_per_simd, s.latency_cycles, s.inverse_throughput);
}

void run(const Options& options) {
    const std::vector<Shader> shaders = collect(options);
    nlohmann::ordered_json devices, rows = nlohmann::ordered_json::array();
    for (const std::string& family : options.families) {
        const Device device({.radv_family = family, .wants_executable_properties = true});
        devices[family] = device.name();
        fmt::print(
            "\n{}\n\n| N | kernel | instructions | VGPRs | SGPRs | spilled V, S | code, bytes | waves | "
            "latency | inverse throughput |\n|---|---|---|---|---|---|---|---|---|---|\n",
            device.name());
        for (const Shader& shader : shaders) {
            const PipelineStatistics statistics = statistics_of(device, shader.words);
            print_row(shader, statistics);
            rows.push_back(row_of(family, shader, statistics));
        }
    }
    if (options.json.empty()) return;
    const fs::path unfinished = options.json + ".tmp";
    std::ofstream stream(unfinished);
    stream << nlohmann::ordered_json{{"devices", devices}, {"pipelines", rows}}.dump(1) << "\n";
    stream.close();
    if (!stream) throw std::runtime_error(unfinished.string() + ": cannot be written");
    fs::rename(unfinished, options.json);
}

}  // namespace

int main(int argc, char** argv) {
    Options options;
    CLI::App app(
        "Registers, instructions and estimated cycles of the compute shaders, by the null device of Mesa's "
        "RADV: needs no GPU");
    zonal::program::add_numbers(app, "--orders", options.orders, zonal::program::from_to(1, 20),
                                "orders; without it all that the folder has");
    app.add_option(
        "--kernels", options.kernels,
        fmt::format("kernels, by what their files are called (rotate_rgb, stable_rotate_zhf); {} is "
                    "signal-tailored rotation, from GLSL",
                    kTailored));
    // RADV calls abort() for a name that it does not know.
    app.add_option("--families", options.families, "GPUs, as RADV of Mesa 22.3 calls them")
        ->check(CLI::IsMember({"polaris10", "vega10", "vega20", "raven", "renoir", "navi10", "navi14",
                               "navi21", "navi22", "navi23", "navi24", "gfx1100", "gfx1102"}))
        ->capture_default_str();
    app.add_option("--spirv", options.spirv,
                   "folder of orderNN/KERNEL.spvasm; those of three channels (_rgb) are "
                   "written by zonal-gen emit --twins")
        ->capture_default_str();
    app.add_option("--glsl", options.glsl, "folder of orderNN/rotate_tailored.glsl")->capture_default_str();
    app.add_option(
           "--module", options.modules,
           "a compute shader of your own, .spv, .spvasm or .comp: storage buffers at bindings 0, 1, 2 "
           "and 4 of set 0, a combined image sampler at 3, one push constant")
        ->check(CLI::ExistingFile);
    app.add_option("--json", options.json, "file to write the same numbers to");
    return zonal::program::run(app, argc, argv, [&] { run(options); });
}
