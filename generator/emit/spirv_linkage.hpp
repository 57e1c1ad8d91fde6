#pragma once

#include <string>
#include <vector>

#include "emit/spirv_body.hpp"

namespace zonal::emit {

/// A kernel and the name under which a form of it is exported.
struct SpirvFunction {
    std::string name;
    const graph::Kernel* kernel = nullptr;
    SpirvForm form;
};

/// A module of functions on pointers to arrays, to be joined with a caller by spirv-link.
std::string print_spirv_functions(const std::vector<SpirvFunction>& functions);

}  // namespace zonal::emit
