#pragma once

#include <string>

#include "emit/spirv_body.hpp"

namespace zonal::emit {

/// A complete compute module for Vulkan 1.1 that turns one vector an invocation: see print_spirv.
std::string print_spirv_compute(const graph::Kernel& kernel, const SpirvForm& form);

}  // namespace zonal::emit
