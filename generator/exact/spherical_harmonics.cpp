#include "exact/spherical_harmonics.hpp"

#include <cmath>

namespace zonal::exact {

template <class S>
Vector<S> evaluate_band(int l, const Direction<S>& direction) {
    using std::sqrt;
    const S x = direction(0), y = direction(1), z = direction(2);
    Vector<S> values(2 * l + 1);
    S cosine{1}, sine{0};  // C_m and S_m
    S sectoral{1};         // d^m P_m / dz^m = (2m-1)!!
    S factorial_ratio{1};  // (l+m)! / (l-m)!
    const S band_norm = S(2 * l + 1) / (4 * static_cast<S>(pi()));
    for (int m = 0; m <= l; ++m) {
        S previous{0}, legendre = sectoral;  // d^m P_k / dz^m for k = m - 1, m
        for (int k = m + 1; k <= l; ++k) {
            const S next = (S(2 * k - 1) * z * legendre - S(k + m - 1) * previous) / S(k - m);
            previous = legendre;
            legendre = next;
        }
        const S norm = sqrt(band_norm * S(m == 0 ? 1 : 2) / factorial_ratio);
        values(l + m) = norm * legendre * cosine;
        if (m > 0) values(l - m) = norm * legendre * sine;

        const S next_cosine = x * cosine - y * sine;
        sine = x * sine + y * cosine;
        cosine = next_cosine;
        sectoral *= S(2 * m + 1);
        factorial_ratio *= S((l + m + 1) * (l - m));  // never used again at m = l, where it becomes 0
    }
    return values;
}

template <class S>
Matrix<S> band_matrix(int l, std::type_identity_t<std::span<const Direction<S>>> directions) {
    Matrix<S> matrix(directions.size(), 2 * l + 1);
    for (int d = 0; d < matrix.rows(); ++d) matrix.row(d) = evaluate_band<S>(l, directions[d]).transpose();
    return matrix;
}

template Vector<double> evaluate_band<double>(int, const Direction<double>&);
template Vector<Real> evaluate_band<Real>(int, const Direction<Real>&);
template Matrix<double> band_matrix<double>(int, std::span<const Direction<double>>);
template Matrix<Real> band_matrix<Real>(int, std::span<const Direction<Real>>);

}  // namespace zonal::exact
