// A quarter turn about z, given as a quaternion, takes the x lobe to the y lobe.
#include <array>
#include <cmath>

#include "zonal/rotate.hpp"

int main() {
    const float half = std::sqrt(0.5F);
    const auto quarter_turn = zonal::RotationMatrix<float>::from_quaternion_xyzw(0, 0, half, half);
    std::array<float, 9> f{};
    f[3] = 1;
    zonal::rotate(3, quarter_turn, std::span<const float>(f), std::span<float>(f));
    return std::abs(f[1] - 1) < 1e-6F && std::abs(f[3]) < 1e-6F ? 0 : 1;
}
