#include "gpu/shader_modules.hpp"

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <spirv-tools/libspirv.hpp>
#include <stdexcept>

namespace zonal::gpu {

namespace {

/// A tool's messages, as one text.
class Messages {
  public:
    spvtools::MessageConsumer consumer() {
        return [this](spv_message_level_t, const char*, const spv_position_t& position, const char* what) {
            text_ += fmt::format("line {}: {}\n", position.line + 1, what);
        };
    }
    void expect(bool is_done, const std::string& task) const {
        if (!is_done) throw std::runtime_error(fmt::format("{}: {}", task, text_));
    }

  private:
    std::string text_;
};

/// glslang is set up once a process.
struct Glslang {
    Glslang() { glslang::InitializeProcess(); }
    ~Glslang() { glslang::FinalizeProcess(); }
};

}  // namespace

std::string read_text(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(stream), {}};
    if (!stream || text.empty())
        throw std::runtime_error(file.string() + ": cannot be read, or is empty; wanted a shader");
    return text;
}

Words assembled(const std::string& text) {
    spvtools::SpirvTools tools(SPV_ENV_UNIVERSAL_1_3);
    Messages messages;
    tools.SetMessageConsumer(messages.consumer());
    Words words;
    messages.expect(tools.Assemble(text, &words, SPV_TEXT_TO_BINARY_OPTION_PRESERVE_NUMERIC_IDS),
                    "SPIR-V cannot be assembled");
    return words;
}

Words compiled(const std::string& source, ShaderLanguage language) {
    static const Glslang once;
    glslang::TShader shader(EShLangCompute);
    const char* text = source.c_str();
    const bool is_hlsl = language == ShaderLanguage::hlsl;
    shader.setStrings(&text, 1);
    shader.setEntryPoint("main");
    shader.setEnvInput(is_hlsl ? glslang::EShSourceHlsl : glslang::EShSourceGlsl, EShLangCompute,
                       glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    const auto rules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules |
                                                (is_hlsl ? EShMsgReadHlsl : EShMsgDefault));
    if (!shader.parse(GetDefaultResources(), 450, false, rules))
        throw std::runtime_error(
            fmt::format("{} cannot be compiled: {}", is_hlsl ? "HLSL" : "GLSL", shader.getInfoLog()));
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(rules))
        throw std::runtime_error(
            fmt::format("{} cannot be linked: {}", is_hlsl ? "HLSL" : "GLSL", program.getInfoLog()));
    Words words;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), words);
    return words;
}

Words read_shader(const std::filesystem::path& file) {
    const std::string content = read_text(file), ending = file.extension();
    try {
        if (ending == ".spvasm") return assembled(content);
        if (ending == ".comp") return compiled(content);
    } catch (const std::runtime_error& error) {
        throw std::runtime_error(fmt::format("{}: {}", file.string(), error.what()));
    }
    if (ending != ".spv")
        throw std::runtime_error(fmt::format(
            "{}: found the ending '{}', wanted .spvasm, .spv or .comp; rename it", file.string(), ending));
    Words words(content.size() / sizeof(std::uint32_t));
    if (content.size() % sizeof(std::uint32_t) != 0)
        throw std::runtime_error(file.string() + ": no SPIR-V: its size is no multiple of 4 bytes");
    std::memcpy(words.data(), content.data(), content.size());
    return words;
}

}  // namespace zonal::gpu
