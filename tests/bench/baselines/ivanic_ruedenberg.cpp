// Dense blocks of all bands from the 3x3 matrix, each from the block before and band 1.
//
// R^l_mn = s_n (u_m U + v_m V + w_m W), where U, V, W are one or two values P_i(a, n) each:
//     P_i(a, n) = r_i0 R^(l-1)_an                                    for |n| < l
//     P_i(a, +-l) = r_i1 R^(l-1)_(a, +-(l-1)) -+ r_i-1 R^(l-1)_(a, -+(l-1))
// So a row of band l is a fixed combination of at most five rows of P; which and how much is tabulated, and
// 1 / sqrt(denominator), which depends on n alone, is taken out.
//
// Source: J. Ivanic, K. Ruedenberg, J. Phys. Chem. 100 (1996) 6342, tables 1 and 2, with the corrections of
// J. Phys. Chem. A 102 (1998) 9099; V of m < 0 as derived, P_1(m+1)(1 - d) + P_-1(-m-1) sqrt(1 + d), d = [m =
// -1]. Limit : the error grows with l, about as l eps.

#include "bench/baselines/ivanic_ruedenberg.hpp"

#include <algorithm>
#include <cmath>

namespace zonal::baselines {
namespace {

/// Row and column of the 3x3 matrix that belongs to m = -1, 0, 1 of band 1: y, z, x.
constexpr int kAxes[3] = {1, 2, 0};

}  // namespace

template <class T>
IvanicRuedenberg<T>::IvanicRuedenberg(int order)
    : order_(order), column_scales_(order * order), dense_(block_offset(order)), band_(2 * order - 1) {
    rows_.resize(4);  // bands 0 and 1 come from R itself
    for (int l = 2; l < order; ++l) {
        add_rows(l);
        for (int n = -l; n <= l; ++n) {
            const int squared = std::abs(n) == l ? 2 * l * (2 * l - 1) : (l + n) * (l - n);
            column_scales_[l * (l + 1) + n] = 1 / std::sqrt(static_cast<T>(squared));
        }
    }
}

template <class T>
void IvanicRuedenberg<T>::add_rows(int l) {
    const T sqrt2 = std::sqrt(static_cast<T>(2));
    const auto root = [](int squared) { return std::sqrt(static_cast<T>(squared)); };
    for (int m = -l; m <= l; ++m) {
        const int first = static_cast<int>(terms_.size());
        const int a = std::abs(m);
        const T u = root((l + m) * (l - m));
        const T v = root((l + a - 1) * (l + a)) / 2;
        const T w = -root((l - a - 1) * (l - a)) / 2;
        const auto add = [&](int axis, int row, T coefficient) {
            if (coefficient != 0) terms_.push_back({axis, row, coefficient});
        };
        add(0, m, u);
        if (m == 0) {
            add(1, 1, -v * sqrt2);
            add(-1, -1, -v * sqrt2);
        } else if (m > 0) {
            add(1, m - 1, m == 1 ? v * sqrt2 : v);
            if (m != 1) add(-1, -m + 1, -v);
            add(1, m + 1, w);
            add(-1, -m - 1, w);
        } else {
            if (m != -1) add(1, m + 1, v);
            add(-1, -m - 1, m == -1 ? v * sqrt2 : v);
            add(1, m - 1, w);
            add(-1, -m + 1, -w);
        }
        rows_.push_back({first, static_cast<int>(terms_.size()) - first});
    }
}

template <class T>
void IvanicRuedenberg<T>::next_block(int l, const T* band_1, const T* previous, T* block) const {
    const int width = 2 * l + 1;
    const T* scales = &column_scales_[l * l];
    for (int m = -l; m <= l; ++m) {
        T* row = block + (m + l) * width;
        std::fill(row, row + width, T(0));
        const Row& recipe = rows_[l * (l + 1) + m];
        for (int k = recipe.first_term; k < recipe.first_term + recipe.terms; ++k) {
            const Term& term = terms_[k];
            const T* r = band_1 + 3 * (term.axis + 1);
            const T* p = previous + (term.row + l - 1) * (width - 2);
            const T left = term.coefficient * r[0];
            const T middle = term.coefficient * r[1];
            const T right = term.coefficient * r[2];
            row[0] += right * p[0] + left * p[width - 3];
            for (int n = 1; n < width - 1; ++n) row[n] += middle * p[n - 1];
            row[width - 1] += right * p[width - 3] - left * p[0];
        }
        for (int n = 0; n < width; ++n) row[n] *= scales[n];
    }
}

template <class T>
void IvanicRuedenberg<T>::blocks(const T* R, T* dense) const {
    dense[0] = 1;
    if (order_ < 2) return;
    T* band_1 = dense + 1;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) band_1[3 * i + j] = R[3 * kAxes[i] + kAxes[j]];
    for (int l = 2; l < order_; ++l)
        next_block(l, band_1, dense + block_offset(l - 1), dense + block_offset(l));
}

template <class T>
void IvanicRuedenberg<T>::rotate(const T* R, const T* f, T* out) {
    blocks(R, dense_.data());
    for (int l = 0; l < order_; ++l) {
        const int width = 2 * l + 1;
        std::copy(f + l * l, f + l * l + width, band_.begin());
        const T* row = &dense_[block_offset(l)];
        for (int m = 0; m < width; ++m, row += width) {
            T sum = 0;
            for (int n = 0; n < width; ++n) sum += row[n] * band_[n];
            out[l * l + m] = sum;
        }
    }
}

template class IvanicRuedenberg<float>;
template class IvanicRuedenberg<double>;
template class IvanicRuedenberg<long double>;

}  // namespace zonal::baselines
