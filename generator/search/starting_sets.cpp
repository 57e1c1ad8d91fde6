#include "search/starting_sets.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace zonal::search {
namespace {

/// What the lobes of a set so far span, band by band: orthonormal columns.
class Spans {
  public:
    Spans(const CandidateGrid& grid, const std::vector<int>& bands) : grid_(&grid) {
        for (const int l : bands) bands_.push_back({l, exact::Matrix<double>(2 * l + 1, 2 * l + 1), {}});
    }

    /// Takes the next lobe of the set, unless in a band that has room for it less than this part of its
    /// length is new.
    bool extend(Lobe lobe, double smallest_part) {
        for (Band& band : bands_) {
            if (is_full(band)) continue;
            band.row.resize(2 * band.l + 1);
            grid_->evaluate(band.l, lobe, band.row.data());
            const double length = band.row.norm();
            const auto known = band.basis.leftCols(lobes_);
            for (int pass = 0; pass < 2; ++pass) band.row -= known * (known.transpose() * band.row);
            if (band.row.norm() < smallest_part * length) return false;
        }
        for (Band& band : bands_)
            if (!is_full(band)) band.basis.col(lobes_) = band.row.normalized();
        ++lobes_;
        return true;
    }

  private:
    struct Band {
        int l;
        exact::Matrix<double> basis;
        exact::Vector<double> row;  // of the lobe that is tried, without what is known
    };

    bool is_full(const Band& band) const { return lobes_ > 2 * band.l; }

    const CandidateGrid* grid_;
    std::vector<Band> bands_;
    int lobes_ = 0;
};

}  // namespace

LobeSet draw_regular(const Problem& problem, const CandidateGrid& grid, const Pool& pool, Random& random) {
    constexpr double kSmallestPart = 0.15;
    const int size = 2 * problem.highest_band() + 1;
    Spans spans(grid, {problem.highest_band()});
    LobeSet lobes;
    const int trials = 100 * size;
    for (int trial = 0; trial < trials && static_cast<int>(lobes.size()) < size; ++trial) {
        const Lobe lobe = pool.draw(random);
        if (spans.extend(lobe, kSmallestPart)) lobes.push_back(lobe);
    }
    while (static_cast<int>(lobes.size()) < problem.lobe_count) lobes.push_back(pool.draw(random));
    return lobes;
}

namespace {

bool is_off_equator(const CandidateGrid& grid, Lobe lobe) {
    return lobe.theta != grid.equator() && lobe.theta != grid.pole();
}

/// Precondition: the pool holds such a lobe.
Lobe draw_off_equator(const CandidateGrid& grid, const Pool& pool, Random& random) {
    for (;;) {
        const Lobe lobe = pool.draw(random);
        if (is_off_equator(grid, lobe)) return lobe;
    }
}

/// One try; none where some lobe is not found.
std::optional<LobeSet> try_aligned(const Problem& problem, const CandidateGrid& grid, const Pool& pool,
                                   Random& random) {
    Spans spans(grid, problem.bands);
    const Lobe pole = grid.canonical(grid.pole(), 0);
    LobeSet lobes = {pole};
    spans.extend(pole, 0);
    // The first lobe that has enough to add, the less the longer it takes to find one.
    const auto add = [&](auto draw) {
        constexpr int kTrials = 400;
        constexpr double kLargestPart = 0.2, kSmallestPart = 0.02;
        for (int trial = 0; trial < kTrials; ++trial) {
            const Lobe lobe = draw();
            const double part =
                kLargestPart * std::pow(kSmallestPart / kLargestPart, trial / double{kTrials});
            if (!spans.extend(lobe, part)) continue;
            lobes.push_back(lobe);
            return true;
        }
        return false;
    };
    const Lobe on_equator = grid.canonical(grid.equator(), 0);
    const auto draw_on_equator = [&] { return pool.draw_on_parallel(on_equator, random); };
    const auto draw_anywhere = [&] { return draw_off_equator(grid, pool, random); };
    const auto draw_on_circle = [&] {
        const Lobe lobe = draw_off_equator(grid, pool, random);
        return grid.at(lobe.theta, random.chance(0.5) ? 0 : M_PI).value_or(lobe);
    };
    for (int l = 1; l <= problem.highest_band(); ++l) {
        const bool is_found = l % 2 == 1 ? add(draw_on_equator) && add(draw_on_equator)
                                         : add(draw_on_circle) && add(draw_anywhere);
        if (!is_found) return std::nullopt;
    }
    return lobes;
}

}  // namespace

LobeSet draw_aligned(const Problem& problem, const CandidateGrid& grid, const Pool& pool, Random& random) {
    constexpr int kTrials = 500;  // one in three succeeds at N = 9, one in ten at N = 20
    const bool has_any_off_equator =
        std::ranges::any_of(pool.lobes(), [&](const Lobe lobe) { return is_off_equator(grid, lobe); });
    for (int trial = 0; has_any_off_equator && trial < kTrials; ++trial)
        if (const auto lobes = try_aligned(problem, grid, pool, random)) return *lobes;
    return draw_regular(problem, grid, pool, random);
}

}  // namespace zonal::search
