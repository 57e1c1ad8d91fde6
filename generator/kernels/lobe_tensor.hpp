#pragma once

#include "kernels/lobes.hpp"
#include "kernels/rotation_scalars.hpp"

namespace zonal::kernels {

/// Turns band 2 (inputs and outputs 4 … 8 of a kernel whose input 1 is the signal) by its lobes as a tensor.
void build_band_2_tensor(graph::Kernel& kernel, const Matrix3& rows, const LobeSet& lobes);

}  // namespace zonal::kernels
