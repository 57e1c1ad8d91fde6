#pragma once

#include <vector>

#include "emit/file.hpp"
#include "emit/spirv_tools.hpp"
#include "emit/unit.hpp"

namespace zonal::emit {

/// A module as text, and the rules that hold for it.
struct SpirvModule {
    File file;
    SpirvUse use = SpirvUse::vulkan_1_1;
};

/// Prints a unit as modules of SPIR-V 1.3: for each kernel a complete compute module for Vulkan 1.1,
/// STEM_KERNEL.spvasm, a twin STEM_KERNEL_precise.spvasm whose arithmetic is never contracted, and for a
/// kernel of a signal STEM_KERNEL_rgb.spvasm, three channels; and STEM.spvasm, the kernels as functions with
/// linkage. Set 0: binding 0 rotations (or the scalars that `prepare` makes), 1 input, 2 output, tightly
/// packed floats [vector][element][channel]; push constant uint count of vectors at offset 0; workgroup x by
/// SpecId 0. Input and output may be one buffer where they have the same size.
std::vector<SpirvModule> print_spirv(const Unit& unit);

}  // namespace zonal::emit
