#pragma once

// What batches need to know of conventions beside kernel_rotation.

#include <span>

#include "zonal/api.hpp"
#include "zonal/conventions.hpp"

namespace zonal {

/// theirs[j] = scale * ours[index], up to the polar axis: a half turn about z is in the scale, as (-1)^m.
struct Place {
    int index = 0;
    double scale = 1;
    double inverse = 1;
};

/// Places of the order^2 coefficients of a convention whose scales vary within a band; empty for the others,
/// whose vectors a kernel turns as they are. Throws zonal::Error unless the convention has the order.
ZONAL_API std::span<const Place> places_scaled_within_bands(Convention convention, int order);

}  // namespace zonal
