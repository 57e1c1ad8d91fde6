#include "gpu/shader_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <vector>

#include "gpu/emitted_shaders.hpp"

namespace zonal::gpu {

namespace {

namespace fs = std::filesystem;

fs::path folder_of(int order, ShaderLanguage language) {
    return (language == ShaderLanguage::hlsl ? hlsl_folder() : glsl_folder()) / order_stem(order);
}

std::string text_of(int order, const ReferenceKernel& kernel, ShaderLanguage language) {
    return read_text(folder_of(order, language) /
                     (kernel.name + (language == ShaderLanguage::hlsl ? ".hlsl" : ".glsl")));
}

/// What a language calls buffers, the entry and types, so that the rest is the same text in both.
struct Frame {
    const char* start;
    const char* buffer;  ///< by binding, access and name
    const char* read_only;
    const char* read_write;
    const char* push;
    const char* entry;
};

const Frame& frame_of(ShaderLanguage language) {
    static const Frame glsl{"#version 450\n",
                            "layout(std430, binding = {0}) {1} buffer Buffer{0} {{ float {2}[]; }};\n",
                            "readonly",
                            "",
                            "layout(local_size_x_id = 0) in;\n"
                            "layout(push_constant) uniform Push { uint count; };\n",
                            "void main() {\n    uint v = gl_GlobalInvocationID.x;\n"};
    static const Frame hlsl{"#define vec3 float3\n",
                            "[[vk::binding({}, 0)]] {}<float> {};\n",
                            "StructuredBuffer",
                            "RWStructuredBuffer",
                            "struct Push { uint count; };\n"
                            "[[vk::push_constant]] ConstantBuffer<Push> push;\n#define count push.count\n",
                            "[numthreads(64, 1, 1)]\nvoid main(uint3 id : SV_DispatchThreadID) {\n"
                            "    uint v = id.x;\n"};
    return language == ShaderLanguage::hlsl ? hlsl : glsl;
}

}  // namespace

std::string compute_shader(int order, const ReferenceKernel& kernel, int channels, ShaderLanguage language) {
    const Frame& frame = frame_of(language);
    const auto buffer = [&](int binding, bool is_input, const char* name) {
        return fmt::format(fmt::runtime(frame.buffer), binding, is_input ? frame.read_only : frame.read_write,
                           name);
    };
    const std::string type = channels == 3 && kernel.has_signal() ? "vec3" : "float";
    std::string declarations, loads, arguments;
    if (kernel.rotation_size > 0) {
        declarations += buffer(0, true, "rotations");
        loads += fmt::format(
            "    float R[{0}];\n    for (int a = 0; a < {0}; ++a) R[a] = rotations[int(v) * {0} + a];\n",
            kernel.rotation_size);
        arguments += "R, ";
    }
    if (kernel.has_signal()) {
        declarations += buffer(1, true, "inputs");
        loads += fmt::format("    {0} f[{1}];\n    for (int i = 0; i < {1}; ++i)\n", type, kernel.input_size);
        for (int c = 0; c < channels; ++c)
            loads += fmt::format("{} inputs[(int(v) * {} + i) * {} + {}]",
                                 c == 0 ? fmt::format("        f[i] = {}(", type) : ",", kernel.input_size,
                                 channels, c);
        loads += ");\n";
        arguments += "f, ";
    }
    std::string stores = fmt::format("    for (int k = 0; k < {}; ++k) {{\n", kernel.output_size);
    for (int c = 0; c < channels; ++c)
        stores += fmt::format("        outputs[(int(v) * {} + k) * {} + {}] = o[k]{};\n", kernel.output_size,
                              channels, c, type == "vec3" ? fmt::format("[{}]", c) : "");
    stores += "    }\n";
    return frame.start + text_of(order, kernel, language) + frame.push + declarations +
           buffer(2, false, "outputs") + frame.entry + "    if (v >= count) return;\n" + loads +
           fmt::format("    {} o[{}];\n    zonal_order{}_{}({}o);\n", type, kernel.output_size, order,
                       kernel.name, arguments) +
           stores + "}\n";
}

std::string fragment_shader(int order, const ReferenceKernel& kernel, int channels) {
    const bool is_vec3 = channels == 3 && kernel.has_signal();
    const std::string type = is_vec3 ? "highp vec3" : "highp float";
    std::string text =
        "#version 300 es\nprecision mediump float;\n" + text_of(order, kernel, ShaderLanguage::glsl);
    text +=
        "uniform highp sampler2D rotations, inputs;\n"
        "layout(location = 0) out highp vec4 results;\n"
        "void main() {\n"
        "    highp int vector = int(gl_FragCoord.y), pixel = int(gl_FragCoord.x);\n";
    std::string arguments;
    if (kernel.rotation_size > 0) {
        text += fmt::format(
            "    highp float R[{0}];\n"
            "    for (int i = 0; i < {0}; ++i) R[i] = texelFetch(rotations, ivec2(i, vector), 0).r;\n",
            kernel.rotation_size);
        arguments += "R, ";
    }
    if (kernel.has_signal()) {
        text += fmt::format("    {} f[{}];\n", type, kernel.input_size);
        for (int c = 0; c < (is_vec3 ? 3 : 1); ++c)
            text += fmt::format(
                "    for (int i = 0; i < {}; ++i)\n"
                "        f[i]{} = texelFetch(inputs, ivec2({} * i + {}, vector), 0).r;\n",
                kernel.input_size, is_vec3 ? fmt::format("[{}]", c) : "", is_vec3 ? 3 : 1, c);
        arguments += "f, ";
    }
    text += fmt::format("    {} o[{}];\n    zonal_order{}_{}({}o);\n", type, kernel.output_size, order,
                        kernel.name, arguments);
    // Indices are constant: of an array that is indexed by a variable llvmpipe makes far more code.
    const int size = kernel.output_size * (is_vec3 ? 3 : 1);
    for (int i = 0; i < size; ++i)
        text += fmt::format("    if (pixel == {}) results[{}] = o[{}];\n", i / 4, i % 4,
                            is_vec3 ? fmt::format("{}][{}", i / 3, i % 3) : fmt::format("{}", i));
    return text + "}\n";
}

bool divides(int order, const ReferenceKernel& kernel) {
    std::istringstream lines(text_of(order, kernel, ShaderLanguage::glsl));
    for (std::string line; std::getline(lines, line);)
        if (!line.starts_with("//") && line.find(" / ") != std::string::npos) return true;
    return false;
}

std::string shader_of_all_files(int order, ShaderLanguage language) {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_of(order, language)))
        files.push_back(entry.path());
    std::ranges::sort(files);
    std::string text = frame_of(language).start;
    for (int k = 0; k < 2; ++k)
        for (const fs::path& file : files) text += read_text(file);
    const bool is_hlsl = language == ShaderLanguage::hlsl;
    return text + (is_hlsl ? "[numthreads(64, 1, 1)]\n" : "layout(local_size_x = 64) in;\n") +
           "void main() {}\n";
}

}  // namespace zonal::gpu
