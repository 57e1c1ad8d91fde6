#include "search/orbits.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

namespace zonal::search {
namespace {

double phi_of(const CandidateGrid& grid, Lobe lobe) {
    return static_cast<double>(grid.phis()[lobe.phi].value);
}

/// Appends the lobe at (theta, phi) unless the orbit has it; false where the grid lacks it.
bool append(Orbit& orbit, const CandidateGrid& grid, int theta, double phi) {
    const std::optional<Lobe> lobe = grid.at(theta, phi);
    if (!lobe) return false;
    if (contains(orbit.lobes, *lobe)) return true;
    const bool is_antipode = theta == grid.equator() && std::cos(phi - phi_of(grid, *lobe)) < 0;
    orbit.lobes.push_back(*lobe);
    orbit.signs.push_back(is_antipode ? -1 : 1);
    return true;
}

/// The orbit of a lobe, of which one that lies on the first mirror comes first: then Fourier sums split even
/// functions from odd ones. None where the grid lacks a lobe of it.
std::optional<Orbit> orbit_of(const CandidateGrid& grid, Lobe lobe, int mirrors) {
    Orbit orbit;
    double phi = phi_of(grid, lobe);
    for (int step = 0; step < mirrors; ++step) {
        const double turned = phi + step * 2 * M_PI / mirrors;
        if (std::abs(std::sin(turned)) < 1e-9) phi = turned;
    }
    for (const double start : {phi, -phi}) {
        for (int step = 0; step < mirrors; ++step)
            if (!append(orbit, grid, lobe.theta, start + step * 2 * M_PI / mirrors)) return std::nullopt;
        if (start == phi) orbit.steps = orbit.size();
    }
    orbit.has_pairs = orbit.size() > orbit.steps;
    orbit.has_half_turn = lobe.theta == grid.equator() && mirrors % 2 == 0;
    return orbit;
}

}  // namespace

OrbitPool::OrbitPool(const CandidateGrid& grid, const Pool& pool, int mirrors) {
    std::set<LobeSet> known;
    for (const Lobe lobe : pool.lobes()) {
        const std::optional<Orbit> orbit = orbit_of(grid, lobe, mirrors);
        if (!orbit) continue;
        LobeSet sorted = orbit->lobes;
        std::ranges::sort(sorted);
        if (known.insert(sorted).second) orbits_.push_back(*orbit);
    }
}

std::optional<std::vector<int>> OrbitPool::orbits_of(const LobeSet& lobes) const {
    std::vector<int> numbers;
    std::size_t covered = 0;
    for (int number = 0; number < size(); ++number) {
        const auto is_inside = [&](Lobe lobe) { return contains(lobes, lobe); };
        if (!std::ranges::all_of(orbits_[number].lobes, is_inside)) continue;
        numbers.push_back(number);
        covered += orbits_[number].lobes.size();
    }
    if (covered != lobes.size()) return std::nullopt;
    return numbers;
}

OrbitTransform fourier_sums(const Orbit& orbit, bool is_odd_band) {
    const int steps = orbit.steps;
    exact::Matrix<double> around(steps, steps);
    int row = 0;
    // Periods in all steps: whole numbers, or halves of odd ones where the values change their sign.
    for (double periods = orbit.has_half_turn && is_odd_band ? 0.5 : 0; row < steps; ++periods) {
        const bool has_sine = periods > 0 && 2 * periods < steps;
        for (int step = 0; step < steps; ++step) {
            around(row, step) = std::cos(2 * M_PI * periods * step / steps);
            if (has_sine) around(row + 1, step) = std::sin(2 * M_PI * periods * step / steps);
        }
        row += 1 + has_sine;
    }
    // Instructions of a real Fourier transform.
    constexpr std::array<int, kMostMirrors + 1> kAdditions{0, 0, 2, 4, 6, 16, 14, 36, 20, 40, 42, 100, 44};
    const int additions = kAdditions.at(steps);
    if (!orbit.has_pairs) return {around, additions};
    exact::Matrix<double> both(2 * steps, 2 * steps);
    both << around, around, around, -around;
    return {both, 2 * additions + 2 * steps};
}

}  // namespace zonal::search
