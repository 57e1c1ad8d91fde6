// The turned probe is f(R^T w) at points in general position, in every channel.
#include "probe.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>
#include <zonal/basis.hpp>
#include <zonal/eigen.hpp>

namespace {

std::vector<zonal::Rgb<double>> in_double(const Probe& probe) {
    std::vector<zonal::Rgb<double>> result;
    for (const auto& colour : probe) result.push_back(colour.cast<double>());
    return result;
}

}  // namespace

int main() {
    Probe probe;
    for (int i = 0; i < 16; ++i) {
        const auto x = static_cast<float>(i);
        probe[i] = {std::sin(x + 1), std::cos(2 * x), std::sin(3 * x + 2)};
    }
    const Eigen::Matrix3d rotation =
        Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
    const auto before = in_double(probe);
    const auto after = in_double(turned(probe, zonal::RotationMatrix<float>(rotation)));
    for (const Eigen::Vector3d& w : {Eigen::Vector3d(1, 0.2, 0.3), {-0.4, 1, -0.7}, {0.1, -0.5, 1}}) {
        const Eigen::Vector3d unit = w.normalized();
        const auto found = zonal::evaluate(4, after, unit);
        const auto wanted = zonal::evaluate(4, before, rotation.transpose() * unit);
        // Norm below 4 in a channel, a basis of norm 4 / sqrt(4 pi) and a kernel's bound below 2e-6: 1e-5.
        const double error = std::max(
            {std::abs(found.r - wanted.r), std::abs(found.g - wanted.g), std::abs(found.b - wanted.b)});
        if (!(error < 1e-5)) {
            std::printf("wrong by %g\n", error);
            return 1;
        }
    }
}
