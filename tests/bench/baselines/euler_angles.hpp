#pragma once

#include <cmath>

namespace zonal::baselines {

/// R = Rz(alpha) Ry(beta) Rz(gamma), for R of determinant +1.
template <class T>
struct EulerAngles {
    T alpha_rad;
    T beta_rad;
    T gamma_rad;
};

/// beta comes from atan2, as acos would lose half the digits near the poles. There alpha has no meaning
/// either, so gamma is read off Rz(-alpha) R, whatever alpha is: the product stays right.
template <class T>
EulerAngles<T> euler_angles(const T* R) {
    const T alpha = std::atan2(R[5], R[2]);
    const T c = std::cos(alpha), s = std::sin(alpha);
    return {alpha, std::atan2(c * R[2] + s * R[5], R[8]),
            std::atan2(c * R[3] - s * R[0], c * R[4] - s * R[1])};
}

}  // namespace zonal::baselines
