// Turns a probe with an x lobe (1, 2, 3) and a blue z lobe by 90 degrees about z and prints its band 1.
#include <Eigen/Geometry>
#include <cstdio>
#include <numbers>
#include <zonal/eigen.hpp>

#include "probe.hpp"

int main() {
    Probe probe{};
    probe[3] = {1, 2, 3};
    probe[2] = {0, 0, 0.5F};
    const Eigen::AngleAxisf quarter_turn(std::numbers::pi_v<float> / 2, Eigen::Vector3f::UnitZ());
    const Probe result = turned(probe, zonal::RotationMatrix<float>(quarter_turn));
    const auto print = [](char axis, const zonal::Rgb<float>& colour) {
        // + 0.001 keeps a rounded zero from being printed as -0.00.
        std::printf("%c: %.2f %.2f %.2f\n", axis, colour.r + 0.001, colour.g + 0.001, colour.b + 0.001);
    };
    print('y', result[1]);
    print('z', result[2]);
    print('x', result[3]);
}
