#include "search/candidates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>

#include "exact/angles.hpp"
#include "exact/spherical_harmonics.hpp"
#include "search/closed_form_zeros.hpp"

namespace zonal::search {
namespace {

/// Angles closer than this are one angle.
const exact::Real kSameAngle{"1e-40"};

int index_of(const std::vector<Angle>& angles, const exact::Real& value) {
    const auto found = std::ranges::find_if(
        angles, [&](const Angle& angle) { return abs(angle.value - value) < kSameAngle; });
    return found == angles.end() ? -1 : static_cast<int>(found - angles.begin());
}

/// An angle of any number of turns as one number, equal for equal directions.
std::int64_t turn_key(double phi) {
    constexpr std::int64_t kTurn = std::int64_t{1} << 40;
    return std::llround(phi / (2 * M_PI) * static_cast<double>(kTurn)) & (kTurn - 1);
}

std::vector<int> one_to(int max_band) {
    std::vector<int> bands(max_band);
    std::iota(bands.begin(), bands.end(), 1);
    return bands;
}

}  // namespace

CandidateGrid::CandidateGrid(int max_band) : CandidateGrid(max_band, one_to(max_band)) {}

CandidateGrid::CandidateGrid(int max_band, const std::vector<int>& zero_bands)
    : max_band_(max_band), profiles_(max_band + 1) {
    pole_ = add_theta(fraction_of_pi(0, 1));
    equator_ = add_theta(fraction_of_pi(1, 2));
    for (const int l : zero_bands) {
        for (int m = 0; m < l; ++m) {
            for (const Angle& theta : legendre_zero_angles(l, m)) add_theta(theta);
        }
    }
    // sin(m phi) and cos(m phi) together vanish at the multiples of pi/(2m).
    for (int m = 1; m <= max_band; ++m) {
        for (int k = 0; k < 4 * m; ++k) add_phi(fraction_of_pi(k, 2 * m));
    }
}

std::uint16_t narrow_index(std::size_t index) {
    if (index > std::numeric_limits<std::uint16_t>::max())
        throw std::length_error("a grid of candidates has at most 65536 angles of a kind");
    return static_cast<std::uint16_t>(index);
}

int CandidateGrid::add_theta(const Angle& theta) {
    const int known = index_of(thetas_, theta.value);
    if (known >= 0) return known;
    const int added = narrow_index(thetas_.size());
    thetas_.push_back(theta);
    tabulate_theta(theta);
    return added;
}

int CandidateGrid::add_phi(const Angle& phi) {
    const int known = index_of(phis_, phi.value);
    if (known >= 0) return known;
    const int added = narrow_index(phis_.size());
    phis_.push_back(phi);
    tabulate_phi(phi);
    return added;
}

void CandidateGrid::tabulate_theta(const Angle& theta) {
    const exact::Direction<double> on_meridian = exact::direction_of(theta.value, 0).cast<double>();
    for (int l = 0; l <= max_band_; ++l) {
        const exact::Vector<double> values = exact::evaluate_band<double>(l, on_meridian);
        profiles_[l].insert(profiles_[l].end(), values.data() + l, values.data() + 2 * l + 1);
    }
}

void CandidateGrid::tabulate_phi(const Angle& phi) {
    const double value = static_cast<double>(phi.value);
    phi_indices_.emplace(turn_key(value), static_cast<int>(phi_values_.size()));
    phi_values_.push_back(value);
    for (int m = 0; m <= max_band_; ++m) {
        cosines_.push_back(static_cast<double>(exact::Real(cos(m * phi.value))));
        sines_.push_back(static_cast<double>(exact::Real(sin(m * phi.value))));
    }
}

Lobe CandidateGrid::canonical(int theta, int phi) const {
    if (theta == pole_) phi = 0;
    if (theta == equator_ && phi_values_[phi] > 3.14159265358979) {
        const int opposite = index_of_phi(phi_values_[phi] - M_PI);
        if (opposite >= 0) phi = opposite;
    }
    return {static_cast<std::uint16_t>(theta), static_cast<std::uint16_t>(phi)};
}

int CandidateGrid::index_of_phi(double phi) const {
    const auto found = phi_indices_.find(turn_key(phi));
    return found == phi_indices_.end() ? -1 : found->second;
}

std::optional<Lobe> CandidateGrid::at(int theta, double phi) const {
    const int index = index_of_phi(phi);
    if (index < 0) return std::nullopt;
    return canonical(theta, index);
}

Lobe CandidateGrid::random(Random& random) const {
    const int theta = random.below(static_cast<int>(thetas_.size()));
    return canonical(theta, random.below(static_cast<int>(phis_.size())));
}

Lobe CandidateGrid::random_image(Lobe lobe, Random& random) const {
    const double quarter_turns = random.below(4) * M_PI / 2;
    const double phi = phi_values_[lobe.phi];
    return at(lobe.theta, quarter_turns + (random.chance(0.5) ? phi : -phi)).value_or(lobe);
}

void CandidateGrid::evaluate(int l, Lobe lobe, double* row) const {
    const double* profile = profiles_[l].data() + lobe.theta * (l + 1);
    const double* cosine = cosines_.data() + lobe.phi * (max_band_ + 1);
    const double* sine = sines_.data() + lobe.phi * (max_band_ + 1);
    row[l] = profile[0];
    for (int m = 1; m <= l; ++m) {
        row[l + m] = profile[m] * cosine[m];
        row[l - m] = profile[m] * sine[m];
    }
}

exact::Direction<exact::Real> CandidateGrid::direction(Lobe lobe) const {
    return exact::direction_of(thetas_[lobe.theta].value, phis_[lobe.phi].value);
}

}  // namespace zonal::search
