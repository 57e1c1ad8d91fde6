#include "lobes/lobe.hpp"

#include "exact/angles.hpp"

namespace zonal {

Lobe Lobe::at(const std::string& theta, const std::string& phi) {
    return {exact::direction_of(exact::evaluate_closed_form(theta), exact::evaluate_closed_form(phi)), theta,
            phi};
}

std::vector<exact::Direction<exact::Real>> directions_of(const std::vector<Lobe>& lobes) {
    std::vector<exact::Direction<exact::Real>> directions;
    for (const Lobe& lobe : lobes) directions.push_back(lobe.direction);
    return directions;
}

}  // namespace zonal
