// Prints the bits of what the first file turns, and of what the second one does.
#include <cstdint>
#include <cstdio>
#include <cstring>

extern "C" void ZONAL_NAME(const float* R, const float* f, float* out);

int main() {
    const float R[] = {0.36f, 0.48f, -0.8f, -0.8f, 0.6f, 0.0f, 0.48f, 0.64f, 0.6f};
    float f[25], out[57];
    for (int i = 0; i < 25; ++i) f[i] = 1.0f / static_cast<float>(i + 3) - 0.1f * static_cast<float>(i % 4);
    ZONAL_NAME(R, f, out);
    for (const float value : out) {
        std::uint32_t bits;
        std::memcpy(&bits, &value, sizeof bits);
        std::printf("%08x\n", static_cast<unsigned>(bits));
    }
}
