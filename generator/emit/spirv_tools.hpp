#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace zonal::emit {

/// Assembles the text of a compute module and validates it for Vulkan 1.1. Throws std::logic_error, naming
/// the line, for text that is no valid module: a printer's fault, not a user's.
std::vector<std::uint32_t> assemble(const std::string& text);

/// The module after SPIRV-Tools' passes for performance, as text again, with the comment that it begins with.
std::string optimize_spirv(const std::string& text);

}  // namespace zonal::emit
