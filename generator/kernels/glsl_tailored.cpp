// Prints signal-tailored rotation as GLSL: the lobes turned by the inverse rotation, one texture fetch for
// each lobe of each tabulated band, and the sparse product. Source: Nowrouzezahrai, Simari, Fiume 2012,
// eq. 11.
//
// All bands are looked up in the same scaled direction, so that a compiler finds face and coordinates of a
// lobe once for all bands: of order 6 in a quarter fewer instructions (RADV, navi21) than with a scale for
// each band's resolution. The scale keeps bilinear filters within a face: see zonal/signal_tables.hpp.
#include "kernels/glsl_tailored.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "emit/dialects.hpp"
#include "emit/text.hpp"
#include "graph/counts.hpp"
#include "graph/passes.hpp"
#include "kernels/rotations.hpp"

namespace zonal::kernels {

namespace {

using emit::Unit;

/// How a signal that is tabulated in cube maps is sampled: what signal-tailored rotation adds to the kernels
/// `lobes` and `resample` of a unit.
struct TailoredRotation {
    /// A band that is looked up: its expansion is a layer of the cube-map array, in the order of this list.
    struct SampledBand {
        int band = 0;
        int first_sample = 0;  ///< of the band, in the input of `resample`
        int first_output = 0;  ///< of the band, in its output
        int output_count = 0;
        std::vector<int> lobes;  ///< looked up, one a sample, by number in the output of `lobes`
    };
    std::vector<SampledBand> bands;
    /// Rotates the bands that are not looked up: (R, their coefficients) -> the first elements of the output.
    graph::Kernel rotate_low;
};

/// Bands 0 and 1 are those of an order-2 signal: they rotate by its kernel, exactly, and need no table.
TailoredRotation tailored_rotation(const LobeSet& lobes) {
    constexpr int kLowBands = 2;
    TailoredRotation rotation;
    rotation.rotate_low = graph::kernel_named(build_rotations(kLowBands), "rotate_tensor");
    rotation.rotate_low.name = "rotate_low";
    rotation.rotate_low.summary = "Rotates bands 0 and 1: f'(w) = f(R^T w).";
    for (int l = kLowBands; l < lobes.order; ++l)
        rotation.bands.push_back({l, lobes.weight_start(l), l * l, 2 * l + 1, lobes.lobes_of[l]});
    return rotation;
}

/// zonal::kFaceScale of the runtime, 31/32: exact in float.
const char* const kFaceScale = "0.96875";

int fetches(const TailoredRotation& rotation) {
    std::size_t count = 0;
    for (const auto& band : rotation.bands) count += band.lobes.size();
    return static_cast<int>(count);
}

std::vector<std::string> cost_texts(const Unit& unit, const TailoredRotation& rotation) {
    const auto counts = [](const graph::Kernel& kernel) {
        return emit::counts_text(graph::count_operations(kernel).total());
    };
    return {fmt::format("rotate_tailored {} texture fetches and the scaling of {} directions;",
                        fetches(rotation), graph::kernel_named(unit.kernels, "lobes").output.size / 3),
            fmt::format("  lobes {};", counts(graph::kernel_named(unit.kernels, "lobes"))),
            fmt::format("  a channel, resample {}, of which",
                        counts(graph::kernel_named(unit.kernels, "resample"))),
            fmt::format("  bands below {} are not used; rotate_low {}", rotation.bands.front().band,
                        counts(rotation.rotate_low))};
}

std::string banner(const Unit& unit, const TailoredRotation& rotation) {
    std::vector<std::string> lines =
        emit::opening_lines(unit, unit.command(kTailoredName), unit.tables.at("resample"));
    emit::append_key(lines, "cost", cost_texts(unit, rotation));
    emit::append_key(lines, "bound",
                     {"that of the tables: zonal::plan_signal_tables of the runtime states it"});
    emit::append_key(lines, "source", graph::kernel_named(unit.kernels, "resample").sources);
    return emit::comment("//", lines);
}

/// A direction whose bilinear filter stays within a face, whatever level is looked up.
std::string print_face_direction(const Unit& unit) {
    return fmt::format(
        "// The direction in which stretched faces hold the value for w: all but its largest component "
        "times\n"
        "// 31/32, so that a filter never reaches across an edge of the cube. On an edge one is the "
        "largest.\n"
        "highp vec3 zonal_{}_face_direction(highp vec3 w) {{\n"
        "    highp vec3 size = abs(w);\n"
        "    bool is_x = size.x >= max(size.y, size.z);\n"
        "    bool is_y = size.y >= size.z;\n"
        "    return mix(w, {} * w, bvec3(!is_x, is_x || !is_y, is_x || is_y));\n"
        "}}\n",
        unit.name, kFaceScale);
}

/// What `resample` makes of one band's samples.
graph::Kernel resampled_band(const Unit& unit, const TailoredRotation::SampledBand& band) {
    graph::Kernel kernel = graph::kernel_named(unit.kernels, "resample");
    std::erase_if(kernel.stores, [&](const graph::Store& store) {
        return store.index < band.first_output || store.index >= band.first_output + band.output_count;
    });
    return graph::remove_dead(std::move(kernel));
}

/// Band by band, so that no more than one band's samples wait in registers: compilers leave fetches where
/// they stand. (Mesa, navi21, RGB of order 6: all fetches first take 168 registers.)
std::string print_bands(const Unit& unit, const TailoredRotation& rotation) {
    std::string text;
    int layer = 0;
    for (const auto& band : rotation.bands) {
        text += fmt::format("    // Band {}.\n", band.band);
        for (std::size_t d = 0; d < band.lobes.size(); ++d)
            text += fmt::format("    samples[{}] = textureLod(bands, vec4(w{}, {}.0), levels[{}]).rgb;\n",
                                band.first_sample + static_cast<int>(d), band.lobes[d], layer, layer);
        text += emit::print_shader_statements(resampled_band(unit, band), emit::kGlsl, true, 4);
        ++layer;
    }
    return text;
}

std::string print_rotation(const Unit& unit, const TailoredRotation& rotation) {
    const int directions = graph::kernel_named(unit.kernels, "lobes").output.size;
    const int coefficients = graph::kernel_named(unit.kernels, "resample").output.size;
    const int low = rotation.rotate_low.output.size;
    std::string text = fmt::format(
        "// Rotates a static signal of three channels that is tabulated: f'(w) = f(R^T w), signal-tailored.\n"
        "// R : 9 values, row-major, of a rotation or a mirror.\n"
        "// low : {low} values, the coefficients of bands 0 and 1, which rotate without a table.\n"
        "// bands : layer k holds band k + 2 on stretched faces (zonal/signal_tables.hpp);\n"
        "//   filters linear within a level, nearest or linear between levels.\n"
        "// levels : the mip level of each layer, whole numbers.\n"
        "// o : {coefficients} values, index l(l+1)+m.\n"
        "// Error: that stated beside the tables. Source: eq. 11.\n"
        "void zonal_{name}_rotate_tailored(highp float R[9], highp vec3 low[{low}],\n"
        "        highp samplerCubeArray bands, highp float levels[{layers}], out highp vec3 "
        "o[{coefficients}]) {{\n"
        "    highp float inverse[9] = float[9](R[0], R[3], R[6], R[1], R[4], R[7], R[2], R[5], R[8]);\n"
        "    highp float w[{directions}];\n"
        "    zonal_{name}_lobes(inverse, w);\n",
        fmt::arg("name", unit.name), fmt::arg("low", low), fmt::arg("layers", rotation.bands.size()),
        fmt::arg("coefficients", coefficients), fmt::arg("directions", directions));
    for (int d = 0; 3 * d < directions; ++d)
        text += fmt::format("    highp vec3 w{} = zonal_{}_face_direction(vec3(w[{}], w[{}], w[{}]));\n", d,
                            unit.name, 3 * d, 3 * d + 1, 3 * d + 2);
    text += fmt::format("    highp vec3 samples[{}];\n{}", coefficients, print_bands(unit, rotation));
    text +=
        fmt::format("    highp vec3 turned[{}];\n    zonal_{}_rotate_low(R, low, turned);\n", low, unit.name);
    for (int i = 0; i < low; ++i) text += fmt::format("    o[{0}] = turned[{0}];\n", i);
    return text + "}\n";
}

}  // namespace

emit::File print_glsl_tailored(const Unit& unit, const LobeSet& lobes) {
    const TailoredRotation rotation = tailored_rotation(lobes);
    const auto once = [&](const char* name, const std::string& text) {
        return emit::shader_once(fmt::format("{}_{}", unit.name, name), text);
    };
    return {fmt::format("{}/{}.glsl", unit.folder, kTailoredName),
            banner(unit, rotation) + "//\n// For GLSL 4.50 and ES 3.20.\n" +
                emit::print_shader_kernel(unit, graph::kernel_named(unit.kernels, "lobes"), emit::kGlsl) +
                emit::print_shader_kernel(unit, rotation.rotate_low, emit::kGlsl) +
                once("face_direction", print_face_direction(unit)) +
                once(kTailoredName, print_rotation(unit, rotation))};
}

}  // namespace zonal::kernels
