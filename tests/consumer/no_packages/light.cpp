// The dominant light of a lobe along (2, -1, 2) / 3 comes from there.
#include <array>
#include <cmath>

#include "zonal/basis.hpp"
#include "zonal/closed_forms.hpp"

int main() {
    const zonal::Direction direction(2 / 3.0, -1 / 3.0, 2 / 3.0);
    std::array<double, 16> signal;
    zonal::evaluate_basis(4, direction, signal);
    const zonal::Direction found = zonal::dominant_light(4, std::span<const double>(signal)).direction;
    const double error = std::hypot(found.x - direction.x, found.y - direction.y, found.z - direction.z);
    return error < 1e-14 ? 0 : 1;
}
