// Ten thousand x lobes, turned on all cores by a quarter turn about z, become y lobes.
#include <cmath>
#include <cstddef>
#include <vector>

#include "zonal/parallel.hpp"

int main() {
    const zonal::RotationMatrix<float> quarter_turn(0, -1, 0, 1, 0, 0, 0, 0, 1);
    const std::size_t count = 10000, coefficients = 9;
    std::vector<float> lobes(count * coefficients);
    for (std::size_t k = 0; k < count; ++k) lobes[k * coefficients + 3] = 1;
    zonal::rotate_all(3, quarter_turn, {.count = count}, lobes, lobes, zonal::on_all_cores());
    const auto is_wrong = [&](std::size_t k) {
        const float* f = &lobes[k * coefficients];
        return std::abs(f[1] - 1) > 1e-6F || std::abs(f[3]) > 1e-6F;
    };
    for (std::size_t k = 0; k < count; ++k)
        if (is_wrong(k)) return 1;
    return 0;
}
