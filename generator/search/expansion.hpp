#pragma once

#include <cstdint>
#include <vector>

#include "exact/matrix.hpp"

namespace zonal::search {

/// The paper's eq. 8: || A D Y - I ||_F^2 of band l as a function of 2l(2l+3) unknowns, the weights of
/// y_l^m, m != 0, and the angles of the lobes d != 0. By eq. 4 lobe d = 0 is the pole and all that y_l^0
/// needs. D is n* = sqrt(4 pi / (2l+1)) times the identity.
class ExpansionResidual {
  public:
    /// Precondition: l >= 1.
    explicit ExpansionResidual(int l) : l_(l) {}

    int unknowns() const { return 2 * l_ * (2 * l_ + 3); }

    /// The residual at `x`: the weights row after row, then theta and phi of lobe after lobe, in radians.
    /// Writes the derivative by every unknown to `gradient` where that is not empty.
    double operator()(const std::vector<double>& x, std::vector<double>& gradient) const;

    /// A: row l+m holds the weights of y_l^m, column l+d those of lobe d.
    exact::Matrix<double> weights(const std::vector<double>& x) const;

    /// theta_{-l}, phi_{-l}, …, theta_l, phi_l.
    std::vector<double> angles(const std::vector<double>& x) const;

  private:
    int size() const { return 2 * l_ + 1; }

    int l_;
};

/// What eq. 8 has for an answer: y_l^m = sum over d of A(l+m, l+d) y_l^0 turned onto lobe d.
struct Expansion {
    exact::Matrix<double> weights;  ///< A
    std::vector<double> angles;     ///< theta, phi of every lobe in radians, of any number of turns
    double residual = 0;            ///< || A D Y - I ||_F^2
    int evaluations = 0;            ///< of the residual with its gradient, over all starts
    int starts = 0;
    double seconds = 0;  ///< of wall time
};

/// Solves eq. 8 for band l >= 1 from random starts until one ends below `expansion_rounding`; the answer
/// depends on the seed alone. Throws std::runtime_error when 100 starts all stall.
Expansion solve_expansion(int l, std::uint64_t seed);

/// The residual that rounding in double leaves of an exact solution. Recurrences and sums of 2l+1 products
/// are right to about 2l+1 epsilon, the phases m phi of a turn to pi l epsilon; so |A D Y - I|_F is right to
/// (2l+1 + pi l) epsilon |A|_F |D Y|_F, and |D Y|_F = sqrt(2l+1) for any lobes by the addition theorem (eq.
/// 6).
double expansion_rounding(int l, const exact::Matrix<double>& weights);

}  // namespace zonal::search
