#pragma once

// How badly a kernel can turn: per band the largest singular value of its error matrix, since no signal of
// the band, and so no signal at all, does worse.

#include <Eigen/Dense>
#include <vector>

#include "support/accuracy.hpp"

namespace zonal {

struct WorstSignal {
    double gain = 0;             ///< |error| / |signal|, to first order
    std::vector<double> signal;  ///< of one band
};

/// The signal that `kernel` turns worst by R, given in its type and as the oracle's blocks of it.
template <class T>
WorstSignal worst_signal(int order, const std::vector<std::vector<oracle::Real>>& exact, const T* R,
                         const accuracy::Contestant<T>& kernel) {
    const int count = order * order;
    std::vector<std::vector<T>> columns;
    for (int j = 0; j < count; ++j) {
        std::vector<T> f(count, 0), out(count);
        f[j] = 1;
        kernel.rotate(R, f.data(), out.data());
        columns.push_back(std::move(out));
    }
    WorstSignal worst;
    for (int l = 0; l < order; ++l) {
        const int size = 2 * l + 1;
        Eigen::MatrixXd errors(size, size);
        for (int i = 0; i < size; ++i)
            for (int j = 0; j < size; ++j)
                errors(i, j) = static_cast<double>(columns[l * l + j][l * l + i] - exact[l][i * size + j]);
        const Eigen::BDCSVD<Eigen::MatrixXd> svd(errors, Eigen::ComputeThinV);
        if (svd.singularValues()(0) < worst.gain) continue;
        worst.gain = svd.singularValues()(0);
        worst.signal.assign(count, 0);
        for (int j = 0; j < size; ++j) worst.signal[l * l + j] = svd.matrixV()(j, 0);
    }
    return worst;
}

}  // namespace zonal
