#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace zonal::gpu {

using Words = std::vector<std::uint32_t>;

/// Everything here throws std::runtime_error: with the file's name where it cannot be read or is empty, with
/// the message of the tool that refuses its input.

std::string read_text(const std::filesystem::path& file);

/// SPIR-V 1.3 from its text, not validated.
Words assembled(const std::string& text);
enum class ShaderLanguage { glsl, hlsl };
/// A compute shader for Vulkan 1.1, by glslang.
Words compiled(const std::string& text, ShaderLanguage language = ShaderLanguage::glsl);
/// A compute module of a file: SPIR-V as text (.spvasm) or binary (.spv), or GLSL (.comp).
Words read_shader(const std::filesystem::path& file);

}  // namespace zonal::gpu
