#pragma once

#include <string>
#include <vector>

#include "exact/matrix.hpp"

namespace zonal {

/// A direction that carries a zonal harmonic.
struct Lobe {
    exact::Direction<exact::Real> direction;  ///< unit, at 50 digits
    /// The same as spherical angles: a closed form in the small language of `generator/tables/README.md`
    /// ("pi/2", "3*pi/8", "acos(sqrt(3/7))") where one is known, else decimals in radians.
    std::string theta, phi;

    /// Throws std::invalid_argument that quotes a text it cannot read.
    static Lobe at(const std::string& theta, const std::string& phi);
};

std::vector<exact::Direction<exact::Real>> directions_of(const std::vector<Lobe>& lobes);

}  // namespace zonal
