#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace zonal::emit {

/// Which rules a module is held to.
enum class SpirvUse {
    vulkan_1_1,  ///< a complete compute module of SPIR-V 1.3
    linkage      ///< functions of SPIR-V 1.3 for `spirv-link`
};

/// Assembles text and validates the result. Throws std::logic_error, naming the line, for text that is no
/// valid module: a printer's fault, not a user's.
std::vector<std::uint32_t> assemble(const std::string& text, SpirvUse use);

/// The module after SPIRV-Tools' passes for performance, as text again, with the comment that it begins with.
std::string optimize_spirv(const std::string& text, SpirvUse use);

}  // namespace zonal::emit
