#include "gpu/shader_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <vector>

#include "gpu/emitted_shaders.hpp"
#include "gpu/shader_modules.hpp"

namespace zonal::gpu {

namespace {

std::string file_of(int order, const std::string& kernel) {
    return read_text(glsl_folder() / order_stem(order) / (kernel + ".glsl"));
}

}  // namespace

std::string compute_shader(int order, const ReferenceKernel& kernel, int channels) {
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
    return "#version 450\n" + file_of(order, kernel.name) +
           "layout(local_size_x_id = 0) in;\n"
           "layout(push_constant) uniform Push { uint count; };\n" +
           declarations + "layout(std430, binding = 2) buffer Outputs { float outputs[]; };\n" +
           "void main() {\n"
           "    uint vector = gl_GlobalInvocationID.x;\n"
           "    if (vector >= count) return;\n" +
           loads +
           fmt::format("    {} o[{}];\n    zonal_order{}_{}({}o);\n", type, kernel.output_size, order,
                       kernel.name, arguments) +
           stores + "}\n";
}

std::string shader_of_all_files(int order) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(glsl_folder() / order_stem(order)))
        files.push_back(entry.path());
    std::ranges::sort(files);
    std::string text = "#version 450\n";
    for (const auto& file : files) text += read_text(file);
    for (const auto& file : files) text += read_text(file);
    return text + "layout(local_size_x = 64) in;\nvoid main() {}\n";
}

}  // namespace zonal::gpu
