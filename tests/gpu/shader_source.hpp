#pragma once

#include <string>

#include "gpu/reference.hpp"

namespace zonal::gpu {

/// A compute shader around one function of an order's GLSL, with the bindings and the layout of the modules.
/// `channels`: 1 or 3, which is vec3. Only the functions that it needs are taken from the file.
std::string compute_shader(int order, const ReferenceKernel& kernel, int channels);

/// A fragment shader of GLSL ES 3.00 around one function of an order's GLSL, whose user asks for `mediump`
/// floats by default. It reads float textures, a vector a row: `rotations` and `inputs`, an element a texel;
/// and draws a picture of a vector a row, four floats of its results a pixel. `channels`: 1 or 3, which is
/// vec3.
std::string fragment_shader(int order, const ReferenceKernel& kernel, int channels);

/// Whether a kernel's GLSL divides: there is a pole in its formulas.
bool divides(int order, const ReferenceKernel& kernel);

/// The whole file in a compute shader that calls nothing of it.
std::string whole_file_shader(int order);

}  // namespace zonal::gpu
