#include "gpu/shader_source.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "gpu/emitted_shaders.hpp"
#include "gpu/shader_modules.hpp"

namespace zonal::gpu {

namespace {

std::string file_of(int order) { return read_text(glsl_folder() / (order_stem(order) + ".glsl")); }

/// The text of every function of this name: a printed function ends at the first brace at a line's start.
std::string functions_named(const std::string& file, const std::string& name) {
    std::string text;
    const std::string begin = fmt::format("void {}(", name), end = "\n}\n";
    for (std::size_t at = file.find(begin); at != std::string::npos; at = file.find(begin, at + 1))
        text += file.substr(at, file.find(end, at) + end.size() - at);
    return text;
}

std::string function_name(int order, const ReferenceKernel& kernel) {
    return fmt::format("zonal_order{}_{}", order, kernel.name);
}

/// A kernel's functions, and those that they call.
std::string functions_of(int order, const ReferenceKernel& kernel) {
    const std::string file = file_of(order), name = function_name(order, kernel);
    const std::string function = functions_named(file, name);
    if (function.empty()) throw std::runtime_error(fmt::format("order {}: no function {}", order, name));
    return functions_named(file, name + "_channels") + function;
}

}  // namespace

std::string compute_shader(int order, const ReferenceKernel& kernel, int channels) {
    const std::string functions = functions_of(order, kernel), name = function_name(order, kernel);
    const std::string type = channels == 3 && kernel.has_signal() ? "vec3" : "float";
    std::string declarations, loads, arguments;
    if (kernel.rotation_size > 0) {
        declarations += "layout(std430, binding = 0) readonly buffer Rotations { float rotations[]; };\n";
        loads += fmt::format(
            "    float R[{0}];\n    for (int i = 0; i < {0}; ++i) R[i] = rotations[int(vector) * {0} + i];\n",
            kernel.rotation_size);
        arguments += "R, ";
    }
    if (kernel.has_signal()) {
        declarations += "layout(std430, binding = 1) readonly buffer Inputs { float inputs[]; };\n";
        loads += fmt::format("    {0} f[{1}];\n    for (int i = 0; i < {1}; ++i)\n", type, kernel.input_size);
        for (int c = 0; c < channels; ++c)
            loads += fmt::format("{} inputs[(int(vector) * {} + i) * {} + {}]",
                                 c == 0 ? fmt::format("        f[i] = {}(", type) : ",", kernel.input_size,
                                 channels, c);
        loads += ");\n";
        arguments += "f, ";
    }
    std::string stores = fmt::format("    for (int i = 0; i < {}; ++i) {{\n", kernel.output_size);
    for (int c = 0; c < channels; ++c)
        stores += fmt::format("        outputs[(int(vector) * {} + i) * {} + {}] = o[i]{};\n",
                              kernel.output_size, channels, c, type == "vec3" ? fmt::format("[{}]", c) : "");
    stores += "    }\n";
    return "#version 450\n" + functions +
           "layout(local_size_x_id = 0) in;\n"
           "layout(push_constant) uniform Push { uint count; };\n" +
           declarations + "layout(std430, binding = 2) buffer Outputs { float outputs[]; };\n" +
           "void main() {\n"
           "    uint vector = gl_GlobalInvocationID.x;\n"
           "    if (vector >= count) return;\n" +
           loads + fmt::format("    {} o[{}];\n    {}({}o);\n", type, kernel.output_size, name, arguments) +
           stores + "}\n";
}

std::string fragment_shader(int order, const ReferenceKernel& kernel, int channels) {
    const bool is_vec3 = channels == 3 && kernel.has_signal();
    const std::string type = is_vec3 ? "highp vec3" : "highp float";
    std::string text = "#version 300 es\nprecision mediump float;\n" + functions_of(order, kernel);
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
    text += fmt::format("    {} o[{}];\n    {}({}o);\n", type, kernel.output_size,
                        function_name(order, kernel), arguments);
    // Indices are constant: of an array that is indexed by a variable llvmpipe makes far more code.
    const int size = kernel.output_size * (is_vec3 ? 3 : 1);
    for (int i = 0; i < size; ++i)
        text += fmt::format("    if (pixel == {}) results[{}] = o[{}];\n", i / 4, i % 4,
                            is_vec3 ? fmt::format("{}][{}", i / 3, i % 3) : fmt::format("{}", i));
    return text + "}\n";
}

bool divides(int order, const ReferenceKernel& kernel) {
    return functions_of(order, kernel).find(" / ") != std::string::npos;
}

std::string whole_file_shader(int order) {
    return "#version 450\n" + file_of(order) + "layout(local_size_x = 64) in;\nvoid main() {}\n";
}

}  // namespace zonal::gpu
