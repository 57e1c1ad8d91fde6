#include "gpu/modules.hpp"

#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <glslang/SPIRV/GlslangToSpv.h>

#include <fstream>
#include <iterator>
#include <spirv-tools/libspirv.hpp>
#include <spirv-tools/linker.hpp>
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
    if (!stream) throw std::runtime_error(fmt::format("{}: cannot be read", file.string()));
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::filesystem::path spirv_folder() { return ZONAL_SHADERS_DIR "/spirv"; }
std::filesystem::path glsl_folder() { return ZONAL_SHADERS_DIR "/glsl"; }
std::string order_stem(int order) { return fmt::format("order{:02}", order); }

Words assembled(const std::string& text) {
    spvtools::SpirvTools tools(SPV_ENV_UNIVERSAL_1_3);
    Messages messages;
    tools.SetMessageConsumer(messages.consumer());
    Words words;
    messages.expect(tools.Assemble(text, &words, SPV_TEXT_TO_BINARY_OPTION_PRESERVE_NUMERIC_IDS),
                    "SPIR-V cannot be assembled");
    return words;
}

Words compiled(const std::string& glsl) {
    static const Glslang once;
    glslang::TShader shader(EShLangCompute);
    const char* text = glsl.c_str();
    shader.setStrings(&text, 1);
    shader.setEnvInput(glslang::EShSourceGlsl, EShLangCompute, glslang::EShClientVulkan, 100);
    shader.setEnvClient(glslang::EShClientVulkan, glslang::EShTargetVulkan_1_1);
    shader.setEnvTarget(glslang::EShTargetSpv, glslang::EShTargetSpv_1_3);
    const auto rules = static_cast<EShMessages>(EShMsgSpvRules | EShMsgVulkanRules);
    if (!shader.parse(GetDefaultResources(), 450, false, rules))
        throw std::runtime_error(fmt::format("GLSL cannot be compiled: {}", shader.getInfoLog()));
    glslang::TProgram program;
    program.addShader(&shader);
    if (!program.link(rules))
        throw std::runtime_error(fmt::format("GLSL cannot be linked: {}", program.getInfoLog()));
    Words words;
    glslang::GlslangToSpv(*program.getIntermediate(EShLangCompute), words);
    return words;
}

Words linked(const std::vector<Words>& modules) {
    spvtools::Context context(SPV_ENV_UNIVERSAL_1_3);
    Messages messages;
    context.SetMessageConsumer(messages.consumer());
    Words words;
    messages.expect(spvtools::Link(context, modules, &words) == SPV_SUCCESS, "spirv-link");
    spvtools::SpirvTools tools(SPV_ENV_VULKAN_1_1);
    tools.SetMessageConsumer(messages.consumer());
    messages.expect(tools.Validate(words), "the linked module is not valid");
    return words;
}

}  // namespace zonal::gpu
