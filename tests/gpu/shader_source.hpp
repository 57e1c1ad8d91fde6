#pragma once

#include <string>

#include "gpu/reference.hpp"
#include "gpu/shader_modules.hpp"

namespace zonal::gpu {

/// A compute shader around one function of an order, with the bindings and the layout of the modules.
/// `channels`: 1 or 3, which is vec3.
std::string compute_shader(int order, const ReferenceKernel& kernel, int channels,
                           ShaderLanguage language = ShaderLanguage::glsl);

/// All files of an order one after another, twice, in a compute shader that calls nothing of them.
std::string shader_of_all_files(int order, ShaderLanguage language = ShaderLanguage::glsl);

}  // namespace zonal::gpu
