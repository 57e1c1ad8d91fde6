#include "bench/gpu_cost/shader_file.hpp"

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <cstring>
#include <fstream>
#include <spirv-tools/libspirv.hpp>
#include <sstream>
#include <stdexcept>

namespace zonal::gpu_cost {

namespace {

std::vector<std::uint32_t> assemble(const std::string& text, const std::string& name) {
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
    std::string message;
    tools.SetMessageConsumer(
        [&](spv_message_level_t, const char*, const spv_position_t& position, const char* what) {
            message += fmt::format(" line {}: {}", position.line + 1, what);
        });
    std::vector<std::uint32_t> words;
    if (!tools.Assemble(text, &words)) throw std::runtime_error(name + ": no SPIR-V text:" + message);
    return words;
}

/// glslang wants to be told when a process begins and ends to use it.
struct GlslangProcess {
    GlslangProcess() { glslang::InitializeProcess(); }
    ~GlslangProcess() { glslang::FinalizeProcess(); }
};

}  // namespace

std::string read_text(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream || text.str().empty())
        throw std::runtime_error(file.string() + ": cannot be read, or is empty; wanted a shader");
    return text.str();
}

std::vector<std::uint32_t> compile_glsl(const std::string& source, const std::string& name) {
    static const GlslangProcess process;
    glslang::TShader shader(EShLangCompute);
    const char* text = source.c_str();
    shader.setStrings(&text, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    constexpr int kVersion = 450;
    const auto rules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    if (!shader.parse(GetDefaultResources(), kVersion, false, rules))
        throw std::runtime_error(fmt::format("{}: {}", name, shader.getInfoLog()));
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(rules)) throw std::runtime_error(fmt::format("{}: {}", name, program.getInfoLog()));
    std::vector<std::uint32_t> words;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), words);
    return words;
}

std::vector<std::uint32_t> read_shader(const std::filesystem::path& file) {
    const std::string content = read_text(file), name = file.string();
    if (file.extension() == ".spvasm") return assemble(content, name);
    if (file.extension() == ".comp") return compile_glsl(content, name);
    if (file.extension() != ".spv")
        throw std::runtime_error(
            fmt::format("{}: found the ending '{}', wanted .spvasm, .spv or .comp; rename it", name,
                        file.extension().string()));
    if (content.size() % sizeof(std::uint32_t) != 0)
        throw std::runtime_error(name + ": no SPIR-V: its size is no multiple of 4 bytes");
    std::vector<std::uint32_t> words(content.size() / sizeof(std::uint32_t));
    std::memcpy(words.data(), content.data(), content.size());
    return words;
}

}  // namespace zonal::gpu_cost
