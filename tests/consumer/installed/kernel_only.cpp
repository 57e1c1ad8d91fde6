// The kernel of order 4 alone: a quarter turn about z takes the x lobe to the y lobe.
#include <cmath>

#include "zonal/order04.hpp"

int main() {
    const float quarter_turn[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    float f[16] = {}, out[16];
    f[3] = 1;
    zonal::order4::rotate(quarter_turn, f, out);
    return std::abs(out[1] - 1) < 1e-5F && std::abs(out[3]) < 1e-5F ? 0 : 1;
}
