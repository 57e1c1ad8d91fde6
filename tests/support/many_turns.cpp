// The largest errors of rounding are rare: thousands of turns show two thirds of what millions show. So many
// turns are judged by a kernel in double, itself judged by the oracle elsewhere, whose errors are a billionth
// of those in float.

#include "support/many_turns.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "support/case_count.hpp"

namespace zonal::accuracy {
namespace {

/// The orthonormal matrix nearest to one that is orthonormal but for rounding in float, to the accuracy of
/// double: the first terms of (R Rᵀ)^(-1/2) R.
Eigen::Matrix3d nearest_orthonormal(const Eigen::Matrix3d& given) {
    const Eigen::Matrix3d defect = given * given.transpose() - Eigen::Matrix3d::Identity();
    return given - 0.5 * defect * given + 0.375 * defect * defect * given;
}

}  // namespace

std::map<std::string, double> worst_of_many_turns(int order, const std::vector<Contestant<float>>& kernels,
                                                  const Contestant<double>& judge, std::int64_t turns,
                                                  std::uint64_t seed) {
    using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
    using FloatRowMajor = Eigen::Matrix<float, 3, 3, Eigen::RowMajor>;
    const int size = order * order;
    std::mt19937_64 random(seed);
    std::vector<float> signal(size), turned(size);
    std::vector<double> exact(size);
    std::vector<double> most(kernels.size(), -std::numeric_limits<double>::infinity());
    for (std::int64_t turn = 0; turn < cases::some_of(turns); ++turn) {
        const cases::Matrix rotation = cases::random_rotation(random);
        float r[9];
        std::copy(rotation.begin(), rotation.end(), r);
        const Eigen::Matrix3d given = Eigen::Map<const FloatRowMajor>(r).cast<double>();
        const double defect = (given * given.transpose() - Eigen::Matrix3d::Identity()).norm();
        const RowMajor orthonormal = nearest_orthonormal(given);
        const std::vector<double> drawn = cases::random_signal(order, random);
        std::copy(drawn.begin(), drawn.end(), signal.begin());
        const std::vector<double> as_given(signal.begin(), signal.end());
        judge.rotate(orthonormal.data(), as_given.data(), exact.data());
        for (std::size_t k = 0; k < kernels.size(); ++k) {
            kernels[k].rotate(r, signal.data(), turned.data());
            for (int l = 1; l < order; ++l) {
                double error = 0, energy = 0;
                for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
                    const double difference = static_cast<double>(turned[i]) - exact[i];
                    error += difference * difference;
                    energy += as_given[i] * as_given[i];
                }
                most[k] = std::max(most[k], std::sqrt(error / energy) - kernels[k].excess * defect);
            }
        }
    }
    std::map<std::string, double> worst;
    for (std::size_t k = 0; k < kernels.size(); ++k) worst[kernels[k].name] = most[k];
    return worst;
}

}  // namespace zonal::accuracy
