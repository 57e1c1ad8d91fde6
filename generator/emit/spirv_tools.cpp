#include "emit/spirv_tools.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <spirv-tools/optimizer.hpp>
#include <stdexcept>

namespace zonal::emit {

namespace {

constexpr spv_target_env kEnvironment = SPV_ENV_VULKAN_1_1;

std::size_t end_of_comment(const std::string& text) {
    std::size_t end = 0;
    while (end < text.size() && text[end] == ';') end = std::min(text.find('\n', end), text.size() - 1) + 1;
    return end;
}

}  // namespace

std::vector<std::uint32_t> assemble(const std::string& text) {
    spvtools::SpirvTools tools(kEnvironment);
    std::string message;
    tools.SetMessageConsumer(
        [&](spv_message_level_t, const char*, const spv_position_t& position, const char* what) {
            message += fmt::format("line {}: {}\n", position.line + 1, what);
        });
    std::vector<std::uint32_t> module;
    if (!tools.Assemble(text, &module) || !tools.Validate(module))
        throw std::logic_error("SPIR-V is not valid: " + message);
    return module;
}

std::string optimize_spirv(const std::string& text) {
    // A fresh optimizer every time: a second run of one object gives other bytes.
    spvtools::Optimizer optimizer(kEnvironment);
    optimizer.RegisterPerformancePasses();
    std::vector<std::uint32_t> module = assemble(text);
    std::string optimized;
    if (!optimizer.Run(module.data(), module.size(), &module) ||
        !spvtools::SpirvTools(kEnvironment)
             .Disassemble(module, &optimized, SPV_BINARY_TO_TEXT_OPTION_NO_HEADER))
        throw std::logic_error("SPIRV-Tools cannot optimize a module that it found valid");
    return text.substr(0, end_of_comment(text)) + optimized;
}

}  // namespace zonal::emit
