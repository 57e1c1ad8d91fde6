#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

#include "gpu/shader_modules.hpp"

namespace zonal::gpu {

/// Where zonal-gen wrote the shaders of every tested order while the tests were built.
inline std::filesystem::path spirv_folder() { return ZONAL_SHADERS_DIR "/spirv"; }
inline std::filesystem::path glsl_folder() { return ZONAL_SHADERS_DIR "/glsl"; }
inline std::filesystem::path hlsl_folder() { return ZONAL_SHADERS_DIR "/hlsl"; }
/// "order04"
inline std::string order_stem(int order) { return fmt::format("order{:02}", order); }
/// Of the signal-tailored rotation.
inline std::string tailored_text(int order) {
    return read_text(glsl_folder() / order_stem(order) / "rotate_tailored.glsl");
}

}  // namespace zonal::gpu
