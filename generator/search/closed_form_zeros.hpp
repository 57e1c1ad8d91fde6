#pragma once

#include <vector>

#include "search/candidates.hpp"

namespace zonal::search {

/// The angles theta in (0, pi/2) at which P_l^m(cos theta) = 0, descending in theta. Where the polynomial in
/// cos^2(theta) is linear or quadratic the text is a closed form. Preconditions: 0 <= m <= l.
std::vector<Angle> legendre_zero_angles(int l, int m);

/// The angle k*pi/n in lowest terms. Precondition: 0 <= k, 0 < n.
Angle fraction_of_pi(int k, int n);

}  // namespace zonal::search
