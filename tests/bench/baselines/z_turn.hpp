#pragma once

#include <cmath>
#include <vector>

namespace zonal::baselines {

/// A rotation about z: the cosines and sines of 0, angle, 2 angle ... (order - 1) angle, and how they turn a
/// band.
template <class T>
class ZTurn {
  public:
    explicit ZTurn(int order) : cosines_(order, T(1)), sines_(order, T(0)) {}

    /// One sine and one cosine of the standard library for each multiple.
    void set_by_library(T angle_rad) {
        for (std::size_t m = 1; m < cosines_.size(); ++m) {
            const T multiple = static_cast<T>(m) * angle_rad;
            cosines_[m] = std::cos(multiple);
            sines_[m] = std::sin(multiple);
        }
    }

    /// One of each, then the addition theorem on halves, which keeps the chain of roundings short.
    void set_by_addition(T angle_rad) {
        if (cosines_.size() < 2) return;
        cosines_[1] = std::cos(angle_rad);
        sines_[1] = std::sin(angle_rad);
        for (std::size_t m = 2; m < cosines_.size(); ++m) {
            const std::size_t a = m / 2, b = m - a;
            cosines_[m] = cosines_[a] * cosines_[b] - sines_[a] * sines_[b];
            sines_[m] = sines_[a] * cosines_[b] + cosines_[a] * sines_[b];
        }
    }

    /// in, out : the 2l+1 values of band l; out may be in.
    void apply(int l, const T* in, T* out) const {
        out[l] = in[l];
        for (int m = 1; m <= l; ++m) {
            const T c = in[l + m], s = in[l - m];
            out[l + m] = cosines_[m] * c - sines_[m] * s;
            out[l - m] = sines_[m] * c + cosines_[m] * s;
        }
    }

  private:
    std::vector<T> cosines_;
    std::vector<T> sines_;
};

}  // namespace zonal::baselines
