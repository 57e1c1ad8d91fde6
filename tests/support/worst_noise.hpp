#pragma once

// What noise in R costs a kernel at the worst, over noise and signal both: no oracle, since to first order
// the orthonormal matrix nearest to (I + S) Q, S small and symmetric, is Q, and a kernel is right at Q.

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "support/accuracy.hpp"

namespace zonal {

/// Band l's largest |error| / (‖R Rᵀ - I‖_F |f|), to first order in the noise, for R near `rotation`: band
/// l's is entry l. Each is found by taking the best noise for a signal and the best signal for the noise in
/// turn, from every unit vector of the band: what is returned is met, and seldom passed.
inline std::vector<double> worst_noise(int order, const accuracy::Contestant<double>& kernel,
                                       const cases::Matrix& rotation) {
    using Block = Eigen::MatrixXd;
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    constexpr double kStep = 1e-5;  // central differences: its square is left out
    constexpr int kKinds = 6, kTurns = 20;

    // slopes[l][k]: the derivative of band l's matrix along the k-th of six orthonormal symmetric matrices.
    std::vector<std::vector<Block>> slopes(order, std::vector<Block>(kKinds));
    const auto matrices_at = [&](const RowMajor& R) {
        std::vector<Block> bands;
        for (int l = 0; l < order; ++l) bands.push_back(Block(2 * l + 1, 2 * l + 1));
        std::vector<double> f(order * order), out(order * order);
        for (int l = 0; l < order; ++l) {
            for (int j = 0; j < 2 * l + 1; ++j) {
                f.assign(f.size(), 0);
                f[l * l + j] = 1;
                kernel.rotate(R.data(), f.data(), out.data());
                bands[l].col(j) = Eigen::Map<Eigen::VectorXd>(out.data() + l * l, 2 * l + 1);
            }
        }
        return bands;
    };
    const Eigen::Map<const RowMajor> Q(rotation.data());
    for (int row = 0, k = 0; row < 3; ++row) {
        for (int column = row; column < 3; ++column, ++k) {
            RowMajor S = RowMajor::Zero();
            S(row, column) = S(column, row) = row == column ? 1 : std::sqrt(0.5);
            const auto ahead = matrices_at((RowMajor::Identity() + kStep * S) * Q);
            const auto behind = matrices_at((RowMajor::Identity() - kStep * S) * Q);
            for (int l = 0; l < order; ++l) slopes[l][k] = (ahead[l] - behind[l]) / (2 * kStep);
        }
    }

    std::vector<double> gains(order, 0);
    for (int l = 0; l < order; ++l) {
        const int size = 2 * l + 1;
        for (int start = 0; start < size; ++start) {
            Eigen::VectorXd f = Eigen::VectorXd::Unit(size, start);
            for (int turn = 0; turn < kTurns; ++turn) {
                Block errors(size, kKinds);
                for (int k = 0; k < kKinds; ++k) errors.col(k) = slopes[l][k] * f;
                const Eigen::VectorXd noise =
                    Eigen::JacobiSVD<Block>(errors, Eigen::ComputeThinU | Eigen::ComputeThinV)
                        .matrixV()
                        .col(0);
                Block error = Block::Zero(size, size);
                for (int k = 0; k < kKinds; ++k) error += noise(k) * slopes[l][k];
                const Eigen::JacobiSVD<Block> svd(error, Eigen::ComputeThinU | Eigen::ComputeThinV);
                f = svd.matrixV().col(0);
                gains[l] = std::max(gains[l], svd.singularValues()(0) / 2);  // ‖R Rᵀ - I‖_F is 2 ‖S‖_F
            }
        }
    }
    return gains;
}

}  // namespace zonal
