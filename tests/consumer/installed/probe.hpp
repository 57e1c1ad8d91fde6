#pragma once

#include <array>
#include <zonal/rgb.hpp>
#include <zonal/rotation.hpp>

/// A light probe of order 4, one colour a coefficient.
using Probe = std::array<zonal::Rgb<float>, 16>;

Probe turned(const Probe& probe, const zonal::RotationMatrix<float>& rotation);
