#pragma once

#include <array>

#include "graph/kernel.hpp"

namespace zonal::kernels {

/// A vector in space as three rotation scalars.
using Vector3 = std::array<graph::Value, 3>;
/// A 3x3 matrix of rotation scalars, by rows.
using Matrix3 = std::array<Vector3, 3>;

/// The argument every rotating kernel takes first.
graph::Array rotation_array();

/// The rotation as given: input 0 of the kernel, named r00 … r22.
Matrix3 rotation_rows(graph::Kernel& kernel);

/// One Newton step towards the nearest orthonormal matrix, R + R (I - RᵀR) / 2: what R lacks in
/// orthonormality, ε = ‖RRᵀ - I‖_F / 2, is left at 1.5 ε². 51 multiplications. For kernels that amplify ε,
/// since they sample polynomials that are harmonic only on the unit sphere. Source: Higham 1986, "Computing
/// the polar decomposition", section 3 (the inverse replaced by its first-order series).
Matrix3 orthonormalized(graph::Kernel& kernel, const Matrix3& rows);

}  // namespace zonal::kernels
