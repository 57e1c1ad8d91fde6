#pragma once

#include "graph/kernel.hpp"
#include "kernels/rotation_scalars.hpp"

namespace zonal::kernels {

/// How the turned tensor becomes coefficients: with as few entries as hold all of it, or each as it is
/// defined. Where R Rᵀ = I both say the same; noise in R costs l/2 ‖R Rᵀ - I‖_F by definition, in bands 2 and
/// 3 up to 2.12 and 1.74 by the trace.
enum class Reading { by_trace, direct };

/// Turns band 1, 2 or 3 of the kernel's input 1 as a vector or a symmetric traceless tensor, and stores it:
/// no division, root, branch or pole; mirrors exact. 9, 35 and 99 instructions for one vector by the trace,
/// 9, 50 and 123 read directly.
void build_contraction_band(graph::Kernel& kernel, const Matrix3& rows, int l, Reading reading);

/// Band 2 in 31 instructions a vector and 4 a rotation. Precondition: determinant +1.
void build_proper_contraction_band_2(graph::Kernel& kernel, const Matrix3& rows);

/// The largest band that a contraction is known for.
inline constexpr int kLargestContractionBand = 3;

}  // namespace zonal::kernels
