#pragma once

// Sets of lobes that tests of the search begin from.

#include <string>
#include <vector>

#include "search/angled_lobe.hpp"

namespace zonal::search {

/// A lobe by the closed forms of its angles.
inline AngledLobe lobe(const char* theta, const char* phi) {
    return {{exact::evaluate_closed_form(theta), theta}, {exact::evaluate_closed_form(phi), phi}};
}

/// Regular lobes of band 4, the last two at the theta that is given.
inline AngledSet lobes_of_band_4(const char* last_theta) {
    return {lobe("0", "0"),
            lobe("pi/2", "0"),
            lobe("pi/2", "pi/8"),
            lobe("pi/2", "3*pi/8"),
            lobe("pi/2", "pi/2"),
            lobe("acos(sqrt(3/7))", "0"),
            lobe("acos(sqrt(3/7))", "pi/2"),
            lobe(last_theta, "pi"),
            lobe(last_theta, "3*pi/2")};
}

/// The 52 zeros of band 4 in closed form.
inline AngledSet best_of_band_4() { return lobes_of_band_4("acos(sqrt((123+6*sqrt(13))/181))"); }

/// On the grid, with 50 zeros.
inline AngledSet band_4_on_the_grid() { return lobes_of_band_4("acos(sqrt(1/7))"); }

inline std::vector<std::string> texts_of(const AngledSet& lobes) {
    std::vector<std::string> texts;
    for (const AngledLobe& each : lobes) texts.push_back(each.theta.text + " " + each.phi.text);
    return texts;
}

}  // namespace zonal::search
