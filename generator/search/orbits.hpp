#pragma once

#include <optional>
#include <vector>

#include "exact/matrix.hpp"
#include "search/pool.hpp"

namespace zonal::search {

/// Most mirrors a set may have.
inline constexpr int kMostMirrors = 12;

/// Lobes that mirrors through the z axis take into one another: equally spaced around the axis, and, off the
/// mirrors, the mirror image of each.
struct Orbit {
    LobeSet lobes;           ///< `steps` around the axis, then their images in the same sense
    std::vector<int> signs;  ///< -1 where what the group gives is the lobe's antipode
    int steps = 1;           ///< around the axis
    bool has_pairs = false;  ///< every lobe has an image that is another lobe
    /// On the equator, of an even number of mirrors: half a turn takes a lobe to its antipode, so that the
    /// steps end there.
    bool has_half_turn = false;

    int size() const { return static_cast<int>(lobes.size()); }
};

/// The orbits of the candidates of a pool under the group that `mirrors` planes through the z axis generate,
/// pi / mirrors apart, the first at phi = 0. (C_1v, C_2v, … in Schoenflies' notation.) In a
/// set made of whole orbits Y_l falls apart into a block for every irreducible representation: Fourier sums
/// over the orbits do the same to the product by Â_l, and mirrors make these sums butterflies.
class OrbitPool {
  public:
    /// Orbits of which a lobe has angles that the grid lacks are left out. Precondition: 1 <= mirrors <=
    /// kMostMirrors.
    OrbitPool(const CandidateGrid& grid, const Pool& pool, int mirrors);

    int size() const { return static_cast<int>(orbits_.size()); }
    const Orbit& operator[](int number) const { return orbits_[number]; }

    /// The orbits that make up a set; none where it holds a part of one.
    std::optional<std::vector<int>> orbits_of(const LobeSet& lobes) const;

  private:
    std::vector<Orbit> orbits_;
};

/// Fourier sums over an orbit: the rows of a matrix that is orthogonal up to the length of each row, size x
/// size, and what it costs to apply it, about.
struct OrbitTransform {
    exact::Matrix<double> rows;
    int additions = 0;
};

/// Of the values of a band's harmonics, each times the sign of its lobe. Those of an odd band change their
/// sign over the steps of an orbit that has a half turn.
OrbitTransform fourier_sums(const Orbit& orbit, bool is_odd_band);

}  // namespace zonal::search
