#include <span>

#include "zonal/error.hpp"
#include "zonal/rotate.hpp"

/// Rotates an order-3 vector in place. rotation: 9 values, row-major; f: `length` values. Returns 1 on an
/// error.
extern "C" __attribute__((visibility("default"))) int turn(const float* rotation, float* f, int length) {
    try {
        const std::span<float> signal(f, static_cast<std::size_t>(length));
        zonal::rotate(3, zonal::RotationMatrix<float>::from_row_major(rotation),
                      std::span<const float>(signal), signal);
        return 0;
    } catch (const zonal::Error&) {
        return 1;
    }
}
