// R = Rz(alpha) Ry(beta) Rz(gamma), applied to a vector band by band in five steps.
//
// Source: A. R. Edmonds, Angular Momentum in Quantum Mechanics, 1960; Kautz, Sloan, Snyder 2002 for the y
// rotation. Limit: determinant +1.

#include "bench/baselines/euler_zyz.hpp"

#include <Eigen/Core>

#include "bench/baselines/euler_angles.hpp"
#include "bench/baselines/ivanic_ruedenberg.hpp"
#include "bench/baselines/quarter_turn.hpp"

namespace zonal::baselines {

template <class T>
EulerZyz<T>::EulerZyz(int order)
    : order_(order),
      quarter_turn_(quarter_turn_blocks<T>(order)),
      alpha_(order),
      beta_(order),
      gamma_(order),
      band_(2 * order - 1),
      turned_(2 * order - 1) {}

template <class T>
void EulerZyz<T>::rotate(const T* R, const T* f, T* out) {
    using Vector = Eigen::Matrix<T, Eigen::Dynamic, 1>;
    using Matrix = Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const EulerAngles<T> angles = euler_angles(R);
    alpha_.set_by_library(angles.alpha_rad);
    beta_.set_by_library(angles.beta_rad);
    gamma_.set_by_library(angles.gamma_rad);
    for (int l = 0; l < order_; ++l) {
        const int width = 2 * l + 1;
        const Eigen::Map<const Matrix> quarter_turn(&quarter_turn_[block_offset(l)], width, width);
        Eigen::Map<Vector> band(band_.data(), width), turned(turned_.data(), width);
        gamma_.apply(l, f + l * l, band_.data());
        turned.noalias() = quarter_turn * band;
        beta_.apply(l, turned_.data(), turned_.data());
        band.noalias() = quarter_turn.transpose() * turned;
        alpha_.apply(l, band_.data(), out + l * l);
    }
}

template class EulerZyz<float>;
template class EulerZyz<double>;

}  // namespace zonal::baselines
