#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace zonal::gpu {

using Words = std::vector<std::uint32_t>;

std::string read_text(const std::filesystem::path& file);

/// The folders that zonal-gen wrote the shaders of every tested order to.
std::filesystem::path spirv_folder();
std::filesystem::path glsl_folder();
/// "order04"
std::string order_stem(int order);

/// The functions below throw std::runtime_error with the message of the tool that refuses its input.

/// SPIR-V 1.3 from its text, not validated.
Words assembled(const std::string& text);
/// A compute shader of GLSL for Vulkan 1.1, by glslang.
Words compiled(const std::string& glsl);
/// What spirv-link makes of modules; complete and valid for Vulkan 1.1.
Words linked(const std::vector<Words>& modules);

}  // namespace zonal::gpu
