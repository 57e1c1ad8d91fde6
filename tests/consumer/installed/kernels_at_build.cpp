// Kernels of orders 3 and 5 that zonal-gen wrote while this project was built.
#include <cmath>

#include "zonal/order03.hpp"
#include "zonal/order05.hpp"

int main() {
    const double quarter_turn[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    double f[25] = {}, three[9], five[25];
    f[3] = 1;
    zonal::order3::rotate(quarter_turn, f, three);
    zonal::order5::rotate(quarter_turn, f, five);
    return std::abs(three[1] - 1) < 1e-12 && std::abs(five[1] - 1) < 1e-12 ? 0 : 1;
}
