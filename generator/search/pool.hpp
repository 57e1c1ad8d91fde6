#pragma once

#include <map>
#include <vector>

#include "search/candidates.hpp"

namespace zonal::search {

/// The lobes of a grid that are drawn from, found by either of their angles.
///
/// Off the equator the pool holds only the meridians phi = k pi / d of a few d, its rings. In a band of even
/// l nearly all good lobes lie on the three coordinate great circles, which is d = 2. Those circles cannot
/// see sin(m phi) of even m where l is odd: there rings of several d are needed, so that no sin(m phi)
/// vanishes on all of them.
class Pool {
  public:
    /// The pole, every phi of the grid on the equator, and every other theta on the meridians of `rings`,
    /// which are added to the grid.
    Pool(CandidateGrid& grid, const std::vector<int>& rings);

    void add(Lobe lobe);
    bool contains(Lobe lobe) const;
    int size() const { return static_cast<int>(lobes_.size()); }
    const std::vector<Lobe>& lobes() const { return lobes_; }

    Lobe draw(Random& random) const;
    /// A lobe with the theta, or with the phi, of one of the pool.
    Lobe draw_on_parallel(Lobe lobe, Random& random) const;
    Lobe draw_on_meridian(Lobe lobe, Random& random) const;

  private:
    std::vector<Lobe> lobes_;
    std::map<int, std::vector<Lobe>> by_theta_, by_phi_;
};

/// The rings that find most for these bands, by trial. A band alone of even l >= 8 wants the great circles;
/// bands up to 5, whose pools are small, many rings; and where m = 12 occurs, which the rings of 4 and 6 do
/// not see, there must be larger ones.
std::vector<int> usual_rings(const std::vector<int>& bands);

/// The bands whose Legendre zeros find most: a band's own, or all of those that share lobes.
std::vector<int> usual_zero_bands(const std::vector<int>& bands);

}  // namespace zonal::search
