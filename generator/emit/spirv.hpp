#pragma once

#include <vector>

#include "emit/file.hpp"
#include "emit/unit.hpp"

namespace zonal::emit {

/// Prints each kernel of a unit as a complete compute module of SPIR-V 1.3 for Vulkan 1.1,
/// FOLDER/KERNEL.spvasm. `has_twins`: beside it KERNEL_precise.spvasm, whose arithmetic is never contracted,
/// and for a kernel of a signal KERNEL_rgb.spvasm, three channels. Set 0: binding 0 rotations (or the scalars
/// that `prepare` makes), 1 input, 2 output, tightly packed floats [vector][element][channel]; push constant
/// uint count of vectors at offset 0; workgroup x by SpecId 0. Input and output may be one buffer where they
/// have the same size.
std::vector<File> print_spirv(const Unit& unit, bool has_twins);

}  // namespace zonal::emit
