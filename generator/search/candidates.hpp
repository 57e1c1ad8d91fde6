#pragma once

#include <algorithm>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "exact/matrix.hpp"
#include "search/random.hpp"

namespace zonal::search {

/// An angle in radians at 50 digits, with its closed form (else its decimals) as text.
struct Angle {
    exact::Real value;
    std::string text;
};

/// A candidate lobe: indices into the thetas and phis of a `CandidateGrid`.
struct Lobe {
    std::uint16_t theta = 0;
    std::uint16_t phi = 0;
    auto operator<=>(const Lobe&) const = default;
};

using LobeSet = std::vector<Lobe>;

inline bool contains(const LobeSet& lobes, Lobe lobe) {
    return std::ranges::find(lobes, lobe) != lobes.end();
}

/// The index of an angle as a `Lobe` holds it. Throws `std::length_error` where it does not fit.
std::uint16_t narrow_index(std::size_t index);

/// The discrete directions among which lobes are sought: theta at the zeros of the Legendre functions P_k^m
/// and phi at the zeros of sin(m phi) and cos(m phi), for bands k = 1 … max_band and 1 <= m <= max_band. A
/// lobe at -w is the lobe at w up to sign, so theta <= pi/2, and phi < pi on the equator. Source:
/// Nowrouzezahrai et al., section 5.
class CandidateGrid {
  public:
    /// Zeros of bands 1 … max_band, as in the paper.
    explicit CandidateGrid(int max_band);

    /// Zeros in theta of the bands of `zero_bands`; in phi of 1 … max_band.
    CandidateGrid(int max_band, const std::vector<int>& zero_bands);

    /// Index of the angle, which is appended when no angle of the grid is within 1e-40 of it. So a search can
    /// start from lobes that lie off the zeros. Precondition: 0 <= theta <= pi/2, 0 <= phi < 2 pi.
    int add_theta(const Angle& theta);
    int add_phi(const Angle& phi);

    int max_band() const { return max_band_; }
    const std::vector<Angle>& thetas() const { return thetas_; }
    const std::vector<Angle>& phis() const { return phis_; }
    int pole() const { return pole_; }
    int equator() const { return equator_; }

    /// The one name of a direction that has several: phi = 0 at the pole, phi < pi on the equator.
    Lobe canonical(int theta, int phi) const;

    /// The lobe of that theta at any phi in radians; none where the grid has no such phi.
    std::optional<Lobe> at(int theta, double phi) const;

    /// Any theta with any phi, as the paper draws them.
    Lobe random(Random& random) const;

    /// The image of a lobe under a random symmetry of the square about the z axis.
    Lobe random_image(Lobe lobe, Random& random) const;

    /// Writes y_l^{-l} … y_l^l at the lobe. Precondition: 1 <= l <= max_band.
    void evaluate(int l, Lobe lobe, double* row) const;

    exact::Direction<exact::Real> direction(Lobe lobe) const;

  private:
    void tabulate_theta(const Angle& theta);
    void tabulate_phi(const Angle& phi);
    int index_of_phi(double phi) const;

    int max_band_;
    std::vector<Angle> thetas_, phis_;
    int pole_ = 0, equator_ = 0;
    std::vector<double> phi_values_;
    std::unordered_map<std::int64_t, int> phi_indices_;  // by phi in units of 2^-40 turns
    std::vector<std::vector<double>> profiles_;  // per band: y_l^m(theta, 0), m = 0 … l, theta after theta
    std::vector<double> cosines_, sines_;        // of m phi, m = 0 … max_band, phi after phi
};

}  // namespace zonal::search
