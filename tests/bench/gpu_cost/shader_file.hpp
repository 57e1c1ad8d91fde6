#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace zonal::gpu_cost {

/// A compute module for Vulkan 1.1 of a file: SPIR-V as text (.spvasm) or binary (.spv), or GLSL (.comp).
/// Throws std::runtime_error, with the file's name and what was wrong, for a file that cannot be read,
/// assembled or compiled.
std::vector<std::uint32_t> read_shader(const std::filesystem::path& file);

/// A compute shader of GLSL 4.50 as a module for Vulkan 1.1. `name` is what errors call it.
std::vector<std::uint32_t> compile_glsl(const std::string& source, const std::string& name);

/// The text of a file; throws std::runtime_error where it cannot be read.
std::string read_text(const std::filesystem::path& file);

}  // namespace zonal::gpu_cost
