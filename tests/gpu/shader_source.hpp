#pragma once

#include <string>

#include "gpu/reference.hpp"

namespace zonal::gpu {

/// A compute shader around one function of an order's GLSL, with the bindings and the layout of the modules.
/// `channels`: 1 or 3, which is vec3.
std::string compute_shader(int order, const ReferenceKernel& kernel, int channels);

/// All files of an order one after another, twice, in a compute shader that calls nothing of them.
std::string shader_of_all_files(int order);

}  // namespace zonal::gpu
