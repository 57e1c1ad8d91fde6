#pragma once

#include <string>

namespace zonal::gpu {

/// A compute shader around zonal_orderN_rotate_tailored, with the memory of the direct modules: rotations at
/// binding 0, the four coefficients of bands 0 and 1 at 1, output at 2, three channels tightly packed; the
/// cube-map array at 3 and its levels at 4. `functions` is the text of rotate_tailored.glsl.
std::string tailored_compute_shader(int order, const std::string& functions);

}  // namespace zonal::gpu
