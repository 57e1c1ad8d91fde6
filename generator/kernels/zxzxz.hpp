#pragma once

#include <compare>
#include <vector>

#include "kernels/angle_powers.hpp"
#include "kernels/rotation_scalars.hpp"

namespace zonal::kernels {

/// How one part of a band (the orders m of one parity) is turned by Y(β) = X Z(β) Xᵀ.
enum class PartForm {
    transform,  ///< Xᵀ, pairs turned by mβ, X: blocks in their cheapest factorization
    update,     ///< even m: the block that holds y-m = 0 is only updated, pair by pair
    scaled,     ///< as transform, blocks as products with unit entries, their scales in the multipliers of β
    sheared,  ///< as transform, blocks as shears of columns of any length, the rest in the multipliers of β
    reflect,  ///< even m: one reflection whose vectors are made once per rotation
};

/// How a band is turned: the forms of its even and odd part.
struct BandForms {
    PartForm even = PartForm::transform;
    PartForm odd = PartForm::transform;
    friend auto operator<=>(const BandForms&, const BandForms&) = default;
};

/// R = Rz(α) Ry(β) Rz(γ) without angles and without a pole: the cosines and sines of the multiples of all
/// three.
struct EulerScalars {
    int order;
    AnglePowers alpha, beta, gamma;

    /// Halves of the even orders m are turned by h = m/2 <= (order-1)/2, so that these powers of β exist
    /// anyway.
    bool has_even_power_of_beta(int m) const { return m <= (order - 1) / 2; }
};

/// Set-up from the rotation as given. Precondition: determinant +1. Where the pole leaves α free, α = 0 or
/// whatever the noise says; the product is right either way.
EulerScalars euler_scalars(graph::Kernel& kernel, const Matrix3& rows, int order);

/// The forms that a band can take.
std::vector<BandForms> band_forms();

/// Turns band l >= 2 of the kernel's input 1 and stores it.
void build_zxzxz_band(graph::Kernel& kernel, EulerScalars& scalars, int l, const BandForms& forms);

}  // namespace zonal::kernels
