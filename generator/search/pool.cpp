#include "search/pool.hpp"

#include <algorithm>
#include <numeric>

#include "search/closed_form_zeros.hpp"

namespace zonal::search {

Pool::Pool(CandidateGrid& grid, const std::vector<int>& rings) {
    const int equator_phis = static_cast<int>(grid.phis().size());
    for (int phi = 0; phi < equator_phis; ++phi) add(grid.canonical(grid.equator(), phi));
    for (const int ring : rings) {
        for (int k = 0; k < 2 * ring; ++k) {
            const int phi = grid.add_phi(fraction_of_pi(k, ring));
            for (std::size_t theta = 0; theta < grid.thetas().size(); ++theta)
                add(grid.canonical(static_cast<int>(theta), phi));
        }
    }
}

void Pool::add(Lobe lobe) {
    if (contains(lobe)) return;
    lobes_.push_back(lobe);
    by_theta_[lobe.theta].push_back(lobe);
    by_phi_[lobe.phi].push_back(lobe);
}

bool Pool::contains(Lobe lobe) const {
    const auto parallel = by_theta_.find(lobe.theta);
    return parallel != by_theta_.end() && std::ranges::find(parallel->second, lobe) != parallel->second.end();
}

namespace {

Lobe one_of(const std::vector<Lobe>& lobes, Random& random) {
    return lobes[random.below(static_cast<int>(lobes.size()))];
}

}  // namespace

Lobe Pool::draw(Random& random) const { return one_of(lobes_, random); }

Lobe Pool::draw_on_parallel(Lobe lobe, Random& random) const {
    const auto lobes = by_theta_.find(lobe.theta);
    return lobes == by_theta_.end() ? draw(random) : one_of(lobes->second, random);
}

Lobe Pool::draw_on_meridian(Lobe lobe, Random& random) const {
    const auto lobes = by_phi_.find(lobe.phi);
    return lobes == by_phi_.end() ? draw(random) : one_of(lobes->second, random);
}

std::vector<int> usual_zero_bands(const std::vector<int>& bands) {
    // Own zeros alone give the few lowest bands too little choice.
    if (bands.size() > 1 || bands.back() > 8) return bands;
    std::vector<int> all(bands.back());
    std::iota(all.begin(), all.end(), 1);
    return all;
}

std::vector<int> usual_rings(const std::vector<int>& bands) {
    const int highest = bands.back();
    if (bands.size() > 1) return highest < 12 ? std::vector{4, 6} : std::vector{4, 6, 8};
    if (highest <= 5) return {6, 8, 10};
    if (highest == 13) return {8, 10};
    if (highest >= 8 && highest % 2 == 0) return {2};
    return highest < 12 ? std::vector{4, 6} : std::vector{6, 8};
}

}  // namespace zonal::search
