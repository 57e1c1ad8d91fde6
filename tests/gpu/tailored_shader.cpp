#include "gpu/tailored_shader.hpp"

#include <fmt/format.h>

namespace zonal::gpu {

std::string tailored_compute_shader(int order, const std::string& functions) {
    constexpr const char* kEntry = R"(
layout(local_size_x_id = 0) in;
layout(std430, set = 0, binding = 0) readonly buffer Rotations {{ float rotations[]; }};
layout(std430, set = 0, binding = 1) readonly buffer Low {{ float low_bands[]; }};
layout(std430, set = 0, binding = 2) writeonly buffer Output {{ float rotated[]; }};
layout(set = 0, binding = 3) uniform samplerCubeArray tables;
layout(std430, set = 0, binding = 4) readonly buffer Levels {{ float levels_of_layers[]; }};
layout(push_constant) uniform Vectors {{ uint count; }};

void main() {{
    uint vector = gl_GlobalInvocationID.x;
    if (vector >= count) return;
    float R[9];
    for (int i = 0; i < 9; ++i) R[i] = rotations[9u * vector + uint(i)];
    vec3 low[4];
    for (int i = 0; i < 4; ++i) {{
        uint at = 12u * vector + 3u * uint(i);
        low[i] = vec3(low_bands[at], low_bands[at + 1u], low_bands[at + 2u]);
    }}
    float levels[{layers}];
    for (int i = 0; i < {layers}; ++i) levels[i] = levels_of_layers[i];
    vec3 o[{size}];
    zonal_order{order}_rotate_tailored(R, low, tables, levels, o);
    for (int i = 0; i < {size}; ++i) {{
        uint at = {floats}u * vector + 3u * uint(i);
        rotated[at] = o[i].r;
        rotated[at + 1u] = o[i].g;
        rotated[at + 2u] = o[i].b;
    }}
}}
)";
    return "#version 450\n" + functions +
           fmt::format(fmt::runtime(kEntry), fmt::arg("order", order), fmt::arg("layers", order - 2),
                       fmt::arg("size", order * order), fmt::arg("floats", 3 * order * order));
}

}  // namespace zonal::gpu
