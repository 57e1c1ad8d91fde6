#pragma once

#include <algorithm>
#include <vector>

#include "exact/angles.hpp"
#include "search/candidates.hpp"

namespace zonal::search {

/// A lobe anywhere on the sphere, on the grid or off it.
struct AngledLobe {
    Angle theta, phi;

    exact::Direction<exact::Real> direction() const { return exact::direction_of(theta.value, phi.value); }
};

using AngledSet = std::vector<AngledLobe>;

inline AngledSet with_angles(const CandidateGrid& grid, const LobeSet& lobes) {
    AngledSet set;
    for (const Lobe lobe : lobes) set.push_back({grid.thetas()[lobe.theta], grid.phis()[lobe.phi]});
    return set;
}

/// The set on the grid, to which angles of its own are added.
inline LobeSet put_on_grid(CandidateGrid& grid, const AngledSet& set) {
    LobeSet lobes;
    for (const AngledLobe& lobe : set)
        lobes.push_back(grid.canonical(grid.add_theta(lobe.theta), grid.add_phi(lobe.phi)));
    return lobes;
}

inline std::vector<exact::Direction<exact::Real>> directions_of(const AngledSet& set) {
    std::vector<exact::Direction<exact::Real>> directions;
    for (const AngledLobe& lobe : set) directions.push_back(lobe.direction());
    return directions;
}

/// theta_0, phi_0, theta_1, phi_1, …
inline std::vector<double> angles_in_double(const AngledSet& set) {
    std::vector<double> angles;
    for (const AngledLobe& lobe : set) {
        angles.push_back(static_cast<double>(lobe.theta.value));
        angles.push_back(static_cast<double>(lobe.phi.value));
    }
    return angles;
}

/// Band l needs its 2l+1 lobes first, in any order. So lobes 0 … 2, 3 and 4, 5 and 6, … may be sorted among
/// themselves, from the pole down.
inline AngledSet in_reading_order(AngledSet set) {
    const auto is_above = [](const AngledLobe& a, const AngledLobe& b) {
        return a.theta.value != b.theta.value ? a.theta.value < b.theta.value : a.phi.value < b.phi.value;
    };
    for (std::size_t first = 0, last = 3; last <= set.size(); first = last, last += 2) {
        std::sort(set.begin() + first, set.begin() + last, is_above);
    }
    return set;
}

}  // namespace zonal::search
