#pragma once

#include <string>

#include "gpu/reference.hpp"
#include "gpu/shader_modules.hpp"

namespace zonal::gpu {

/// A compute shader around one function of an order, with the bindings and the layout of the modules.
/// `channels`: 1 or 3, which is vec3.
std::string compute_shader(int order, const ReferenceKernel& kernel, int channels,
                           ShaderLanguage language = ShaderLanguage::glsl);

/// A fragment shader of GLSL ES 3.00 around one function of an order's GLSL, whose user asks for `mediump`
/// floats by default. It reads float textures, a vector a row: `rotations` and `inputs`, an element a texel;
/// and draws a picture of a vector a row, four floats of its results a pixel. `channels`: 1 or 3, which is
/// vec3.
std::string fragment_shader(int order, const ReferenceKernel& kernel, int channels);

/// Whether a kernel's GLSL divides: there is a pole in its formulas.
bool divides(int order, const ReferenceKernel& kernel);

/// All files of an order one after another, twice, in a compute shader that calls nothing of them.
std::string shader_of_all_files(int order, ShaderLanguage language = ShaderLanguage::glsl);

}  // namespace zonal::gpu
