// Block-diagonal product by Eigen. Bands below kFixedBands have sizes known to the compiler, which unrolls
// and vectorises them; above, the product of run-time size is as fast.

#include "bench/baselines/dense_product.hpp"

#include <Eigen/Core>
#include <utility>

#include "bench/baselines/ivanic_ruedenberg.hpp"

namespace zonal::baselines {
namespace {

constexpr int kFixedBands = 6;

template <int kWidth, class T>
void apply_block(int l, const T* dense, const T* f, T* out) {
    using Matrix = Eigen::Matrix<T, kWidth, kWidth, kWidth == 1 ? Eigen::ColMajor : Eigen::RowMajor>;
    using Vector = Eigen::Matrix<T, kWidth, 1>;
    const int width = 2 * l + 1;
    Eigen::Map<Vector>(out + l * l, width).noalias() =
        Eigen::Map<const Matrix>(dense + block_offset(l), width, width) *
        Eigen::Map<const Vector>(f + l * l, width);
}

template <class T, int... kBands>
void apply_fixed_blocks(int order, const T* dense, const T* f, T* out,
                        std::integer_sequence<int, kBands...>) {
    ((kBands < order ? apply_block<2 * kBands + 1>(kBands, dense, f, out) : void()), ...);
}

}  // namespace

template <class T>
void apply_blocks(int order, const T* dense, const T* f, T* out) {
    apply_fixed_blocks(order, dense, f, out, std::make_integer_sequence<int, kFixedBands>());
    for (int l = kFixedBands; l < order; ++l) apply_block<Eigen::Dynamic>(l, dense, f, out);
}

template void apply_blocks(int, const float*, const float*, float*);
template void apply_blocks(int, const double*, const double*, double*);

}  // namespace zonal::baselines
