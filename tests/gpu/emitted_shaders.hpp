#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <string>

namespace zonal::gpu {

/// Where zonal-gen wrote the shaders of every tested order while the tests were built.
inline std::filesystem::path spirv_folder() { return ZONAL_SHADERS_DIR "/spirv"; }
inline std::filesystem::path glsl_folder() { return ZONAL_SHADERS_DIR "/glsl"; }
/// "order04"
inline std::string order_stem(int order) { return fmt::format("order{:02}", order); }

}  // namespace zonal::gpu
