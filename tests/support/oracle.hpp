#pragma once

#include <array>
#include <vector>

namespace zonal::oracle {

/// The judge of every kernel: pointwise evaluation of f(Rᵀω) in long double and quadrature. It knows
/// spherical harmonics by their definition, P_l^m(cos θ) times cos mφ or sin mφ, and shares no code with the
/// generator or the runtime.
using Real = long double;
using Vector3 = std::array<Real, 3>;
using Matrix3 = std::array<Real, 9>;  ///< row-major

/// y_0^0 … y_{N-1}^{N-1} at a unit direction: real, orthonormal, index l(l+1)+m, no Condon-Shortley sign.
std::vector<Real> basis(int order, const Vector3& direction);

/// sum_i f_i y_i(ω).
Real evaluate(int order, const std::vector<Real>& f, const Vector3& direction);

/// The orthonormal matrix nearest to R (polar factor, by Newton's iteration), determinant ±1 like R's.
Matrix3 nearest_orthonormal(const Matrix3& rotation);

/// ‖R Rᵀ - I‖_F.
Real orthonormality_error(const Matrix3& rotation);

/// Coefficients of ω -> f(Qᵀω) for the orthonormal matrix nearest to R: f'_i = ∫ f(Qᵀω) y_i(ω) dω by a
/// quadrature that is exact for products of two functions of this order (Gauss-Legendre in z, equally spaced
/// in φ). Rounding: about N² units of long double, 2^-64.
class Rotation {
  public:
    explicit Rotation(int order);
    int order() const { return order_; }
    std::vector<Real> operator()(const Matrix3& rotation, const std::vector<Real>& f) const;
    /// The same as matrices: f'_l = blocks[l] f_l, row-major (2l+1)². For many signals of one rotation.
    std::vector<std::vector<Real>> blocks(const Matrix3& rotation) const;

  private:
    /// The nodes of one z, the weight of which is in P_l^m, by l and then m = 0 … l.
    struct Ring {
        std::vector<Vector3> directions;
        std::vector<Real> weighted_legendre;
    };
    int order_;
    std::vector<Ring> rings_;
    std::vector<Real> cosines_, sines_;  ///< times the weight in φ; by node of a ring, then m = 0 … N-1
};

}  // namespace zonal::oracle
