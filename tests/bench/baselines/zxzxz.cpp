// The zxzxz form, scalar, on the nonzeros of Rx(+-90).
//
// Rx(90) takes z to -y and y to z. A function of even l + m is even in z, so its image is even in y and has
// cosines only; one of odd l + m has sines only. Likewise backwards. Both turns keep the parity in x, m +
// [sine] modulo 2. So a row m meets only the columns of one half (cosines when l + m is even), and of those
// every other one (even l + n when m >= 0).
//
// Source: Kautz, Sloan, Snyder 2002. Limit: determinant +1.

#include "bench/baselines/zxzxz.hpp"

#include "bench/baselines/euler_angles.hpp"
#include "bench/baselines/ivanic_ruedenberg.hpp"
#include "bench/baselines/quarter_turn.hpp"

namespace zonal::baselines {

template <class T>
Zxzxz<T>::Zxzxz(int order)
    : order_(order),
      alpha_(order),
      beta_(order),
      gamma_(order),
      band_(2 * order - 1),
      turned_(2 * order - 1) {
    const std::vector<T> dense = quarter_turn_blocks<T>(order);
    for (int l = 0; l < order; ++l) {
        const int width = 2 * l + 1;
        for (int m = -l; m <= l; ++m) {
            const bool is_even = (l + m) % 2 == 0;
            const int parity = m >= 0 ? 0 : 1;  // of l + n
            const int lowest = is_even ? 0 : -l;
            const int highest = is_even ? l : -1;
            const int first = lowest + (l + lowest + parity) % 2;
            const int count = first > highest ? 0 : (highest - first) / 2 + 1;
            rows_.push_back({first + l, count});
            for (int k = 0; k < count; ++k) {
                const int n = first + l + 2 * k;
                forwards_.push_back(dense[block_offset(l) + (m + l) * width + n]);
                backwards_.push_back(dense[block_offset(l) + n * width + m + l]);
            }
        }
    }
}

template <class T>
const T* Zxzxz<T>::apply(int l, const T* values, const T* in, T* out) const {
    const Row* rows = &rows_[l * l];
    for (int m = 0; m <= 2 * l; ++m) {
        const T* column = in + rows[m].first;
        T sum = 0;
        for (int k = 0; k < rows[m].count; ++k) sum += values[k] * column[2 * k];
        values += rows[m].count;
        out[m] = sum;
    }
    return values;
}

template <class T>
void Zxzxz<T>::rotate(const T* R, const T* f, T* out) {
    const EulerAngles<T> angles = euler_angles(R);
    alpha_.set_by_addition(angles.alpha_rad);
    beta_.set_by_addition(angles.beta_rad);
    gamma_.set_by_addition(angles.gamma_rad);
    const T* forwards = forwards_.data();
    const T* backwards = backwards_.data();
    for (int l = 0; l < order_; ++l) {
        gamma_.apply(l, f + l * l, band_.data());
        forwards = apply(l, forwards, band_.data(), turned_.data());
        beta_.apply(l, turned_.data(), turned_.data());
        backwards = apply(l, backwards, turned_.data(), band_.data());
        alpha_.apply(l, band_.data(), out + l * l);
    }
}

template class Zxzxz<float>;
template class Zxzxz<double>;

}  // namespace zonal::baselines
