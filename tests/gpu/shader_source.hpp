#pragma once

#include <string>

#include "gpu/reference.hpp"

namespace zonal::gpu {

/// A compute shader around one function of an order's GLSL, with the bindings and the layout of the modules.
/// `channels`: 1 or 3, which is vec3. Only the functions that it needs are taken from the file.
std::string compute_shader(int order, const ReferenceKernel& kernel, int channels);

/// The whole file in a compute shader that calls nothing of it.
std::string whole_file_shader(int order);

}  // namespace zonal::gpu
