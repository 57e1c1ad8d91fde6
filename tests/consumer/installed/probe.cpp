#include "probe.hpp"

#include <zonal/rotate.hpp>

Probe turned(const Probe& probe, const zonal::RotationMatrix<float>& rotation) {
    Probe result;
    zonal::rotate(4, rotation, std::span<const zonal::Rgb<float>>(probe), std::span(result));
    return result;
}
