// Turns a signal by kernels of generated headers and by what the runtime's headers hold inline, under the
// name ZONAL_NAME: compiled several times with different flags by link_pairs.sh.
#include "zonal/order04.hpp"
#include "zonal/order05.hpp"
#include "zonal/rgb.hpp"

extern "C" void ZONAL_NAME(const float* R, const float* f, float* out) {
    zonal::order4::rotate(R, f, out);
    zonal::order5::rotate_accurate(R, f, out + 16);
    zonal::Rgb<float> rgb[16], turned[16];
    for (int i = 0; i < 16; ++i) rgb[i] = {f[i], f[i + 1], f[i + 2]};
    zonal::order4::rotate(R, rgb, turned);
    for (int i = 0; i < 16; ++i) {
        const zonal::Rgb<float> sum = turned[i] - (-rgb[i]);
        out[41 + i] = sum.r + 3 * sum.g + 5 * sum.b + (turned[i] == rgb[i] ? 1 : 0);
    }
}
