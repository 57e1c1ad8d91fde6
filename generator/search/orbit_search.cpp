#include "search/orbit_search.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>

#include "search/course.hpp"

namespace zonal::search {
namespace {

using exact::Matrix;

/// Of a random orbit, what the lobes already chosen do not span, beside its length.
constexpr double kSmallestPart = 0.1;
constexpr int kMeasuredInAGeneration = 6;
constexpr double kChanceToGoOn = 0.5;  ///< from the island's best in place of a random set

/// A set of whole orbits, by their numbers in the pool.
using OrbitSet = std::vector<int>;

/// What a set of orbits is expected to cost.
class Estimate {
  public:
    Estimate(int l, const CandidateGrid& grid, const OrbitPool& pool)
        : size_(2 * l + 1), pool_(&pool), columns_(size_, size_) {
        for (int number = 0; number < pool.size(); ++number) {
            const Orbit& orbit = pool[number];
            Matrix<double> rows(size_, orbit.size());
            for (int i = 0; i < orbit.size(); ++i) {
                grid.evaluate(l, orbit.lobes[i], rows.col(i).data());
                if (l % 2 != 0) rows.col(i) *= orbit.signs[i];
            }
            rows_.push_back(rows);
            transforms_.push_back(transforms_of(orbit, l % 2 != 0));
        }
    }

    /// Row l+m, column d: y_l^m at lobe d of the orbit.
    const Matrix<double>& rows(int orbit) const { return rows_[orbit]; }

    /// Entries of the product and additions, and norm_weight * log2(||Â||_F ||Y||_F / (2l+1)); infinite where
    /// the set is singular.
    double operator()(const OrbitSet& set, double norm_weight) {
        int first = 0;
        for (const int orbit : set) {
            columns_.middleCols(first, (*pool_)[orbit].size()) = rows_[orbit];
            first += (*pool_)[orbit].size();
        }
        const Matrix<double> a_hat = columns_.partialPivLu().inverse().transpose();
        const double squared_norm = a_hat.squaredNorm();
        if (!(squared_norm < kSingularSquaredNorm)) return std::numeric_limits<double>::infinity();
        int cost = 0;
        first = 0;
        for (const int orbit : set) {
            const int size = (*pool_)[orbit].size();
            cost += cost_of_orbit(orbit, a_hat.middleCols(first, size));
            first += size;
        }
        return cost + norm_weight * std::log2(std::sqrt(squared_norm) * columns_.norm() / size_);
    }

  private:
    static std::vector<OrbitTransform> transforms_of(const Orbit& orbit, bool is_odd_band) {
        std::vector<OrbitTransform> all{fourier_sums(orbit, is_odd_band)};
        if (orbit.has_pairs && orbit.steps > 1) {  // pairs alone
            const Matrix<double> one = Matrix<double>::Identity(orbit.steps, orbit.steps);
            OrbitTransform pairs{Matrix<double>(orbit.size(), orbit.size()), orbit.size()};
            pairs.rows << one, one, one, -one;
            all.push_back(pairs);
        }
        return all;
    }

    int cost_of_orbit(int orbit, const Matrix<double>& a_hat) const {
        const auto nonzeros = [](const auto& matrix) {
            return static_cast<int>((matrix.array().abs() > kZeroInDouble).count());
        };
        int best = nonzeros(a_hat);
        for (const OrbitTransform& transform : transforms_[orbit])
            best = std::min(best, transform.additions + nonzeros(a_hat * transform.rows.transpose()));
        return best;
    }

    int size_;
    const OrbitPool* pool_;
    std::vector<Matrix<double>> rows_;
    std::vector<std::vector<OrbitTransform>> transforms_;  ///< of each orbit
    Matrix<double> columns_;                               ///< Y transposed
};

double cost_of(const Solution& solution, int instructions, const Objective& objective) {
    return instructions + objective.condition_weight * std::log2(solution.score.condition);
}

struct Measured {
    Solution solution;
    int instructions = 0;
    double cost = std::numeric_limits<double>::infinity();
    OrbitSet orbits;
};

/// Meridians on which orbits are whole, on the mirrors and off them.
std::vector<int> rings_of_orbits(int mirrors) {
    return mirrors <= 2 ? std::vector{6, 8} : std::vector{2 * mirrors, 3 * mirrors, 4 * mirrors};
}

class Island {
  public:
    Island(int l, const CandidateGrid& grid, const OrbitPool& pool, const SearchSettings& settings, int moves,
           const EmittedCost& emitted_cost, int index)
        : problem_(Problem::one_band(l)),
          grid_(&grid),
          pool_(&pool),
          settings_(&settings),
          moves_(moves),
          emitted_cost_(&emitted_cost),
          random_(settings.seed, index),
          estimate_(l, grid, pool) {}

    void step(const std::function<bool()>& is_stopped) {
        const bool goes_on = !best_.orbits.empty() && random_.chance(kChanceToGoOn);
        std::optional<OrbitSet> start = goes_on ? best_.orbits : regular_orbits();
        if (!start) return;
        anneal(*start, goes_on ? 1.0 : 3.0, is_stopped);
        for (const auto& [energy, set] : lowest_) measure(set);
    }

    void adopt(const OrbitSet& set) { measure(set); }

    const Measured& best() const { return best_; }
    std::int64_t evaluations() const { return evaluations_; }

  private:
    int room_in(const OrbitSet& set) const {
        int room = problem_.lobe_count;
        for (const int orbit : set) room -= (*pool_)[orbit].size();
        return room;
    }

    bool is_in(const OrbitSet& set, int orbit) const { return std::ranges::find(set, orbit) != set.end(); }

    /// Adds random orbits until the set is whole; false when none fits.
    bool fill(OrbitSet& set) {
        int room = room_in(set);
        for (int trial = 0; trial < 200 && room > 0; ++trial) {
            const int orbit = random_.below(pool_->size());
            if ((*pool_)[orbit].size() > room || is_in(set, orbit)) continue;
            set.push_back(orbit);
            room -= (*pool_)[orbit].size();
        }
        return room == 0;
    }

    /// Random orbits that are regular together.
    std::optional<OrbitSet> regular_orbits() {
        const int size = problem_.lobe_count;
        for (int trial = 0; trial < 30; ++trial) {
            OrbitSet set;
            Matrix<double> basis(size, size);
            int known = 0;
            for (int draw = 0; draw < 100 * size && known < size; ++draw) {
                const int orbit = random_.below(pool_->size());
                const int more = (*pool_)[orbit].size();
                if (known + more > size || !extend(basis, known, estimate_.rows(orbit))) continue;
                set.push_back(orbit);
                known += more;
            }
            if (known == size) return set;
        }
        return std::nullopt;
    }

    /// Appends orthonormal columns that span the new ones too; false when they nearly lie in the span.
    static bool extend(Matrix<double>& basis, int known, const Matrix<double>& columns) {
        for (int i = 0; i < columns.cols(); ++i) {
            exact::Vector<double> column = columns.col(i);
            const auto span = basis.leftCols(known + i);
            for (int pass = 0; pass < 2; ++pass) column -= span * (span.transpose() * column);
            if (column.norm() < kSmallestPart * columns.col(i).norm()) return false;
            basis.col(known + i) = column.normalized();
        }
        return true;
    }

    void anneal(OrbitSet set, double start_temperature, const std::function<bool()>& is_stopped) {
        constexpr double kEndTemperature = 0.1;
        const double norm_weight = 0.2 * std::pow(20, random_.uniform());
        const double cooling = std::pow(kEndTemperature / start_temperature, 1.0 / moves_);
        double energy = estimate_(set, norm_weight), temperature = start_temperature;
        lowest_.clear();
        remember(set, energy);
        for (int move = 0; move < moves_; ++move, temperature *= cooling) {
            if (move % 256 == 0 && is_stopped()) return;
            OrbitSet next = set;
            const int gone = std::min<int>(1 + random_.below(2), static_cast<int>(set.size()));
            for (int i = 0; i < gone; ++i)
                next.erase(next.begin() + random_.below(static_cast<int>(next.size())));
            if (!fill(next)) continue;
            ++evaluations_;
            const double next_energy = estimate_(next, norm_weight);
            if (!(next_energy <= energy - temperature * std::log(1 - random_.uniform()))) continue;
            set = std::move(next);
            energy = next_energy;
            remember(set, energy);
        }
    }

    /// Sets of one energy are nearly always images of each other.
    void remember(const OrbitSet& set, double energy) {
        lowest_.try_emplace(std::round(energy * 1e6) / 1e6, set);
        if (lowest_.size() > kMeasuredInAGeneration) lowest_.erase(std::prev(lowest_.end()));
    }

    void measure(const OrbitSet& set) {
        LobeSet lobes;
        for (const int orbit : set)
            lobes.insert(lobes.end(), (*pool_)[orbit].lobes.begin(), (*pool_)[orbit].lobes.end());
        LobeSet sorted = lobes;
        std::ranges::sort(sorted);
        if (!measured_.insert(sorted).second) return;
        // As a table has them: what is emitted depends on the order.
        Measured measured{confirm(problem_, in_reading_order(with_angles(*grid_, lobes))), 0, 0, set};
        if (!measured.solution.score.is_allowed(settings_->objective)) return;
        measured.instructions =
            (*emitted_cost_)(factorize_band(problem_.highest_band(), directions_of(measured.solution.lobes)));
        measured.cost = cost_of(measured.solution, measured.instructions, settings_->objective);
        if (measured.cost < best_.cost) best_ = std::move(measured);
    }

    Problem problem_;
    const CandidateGrid* grid_;
    const OrbitPool* pool_;
    const SearchSettings* settings_;
    int moves_;
    const EmittedCost* emitted_cost_;
    Random random_;
    Estimate estimate_;
    std::map<double, OrbitSet> lowest_;  ///< of the last annealing, by energy
    std::set<LobeSet> measured_;
    Measured best_;
    std::int64_t evaluations_ = 0;
};

}  // namespace

SearchResult search_orbits(int l, const SearchSettings& settings, const OrbitSettings& orbits,
                           const EmittedCost& emitted_cost, const std::atomic<bool>& stop,
                           const SearchObserver& observer) {
    Course course({settings.generations, settings.seconds, settings.genetic.stall_generations}, stop);
    CandidateGrid grid(l, settings.zero_bands.empty() ? usual_zero_bands({l}) : settings.zero_bands);
    Pool pool(grid, settings.rings.empty() ? rings_of_orbits(orbits.mirrors) : settings.rings);
    std::optional<LobeSet> start;
    if (settings.start) {
        start = put_on_grid(grid, *settings.start);
        for (const Lobe lobe : *start) pool.add(lobe);
    }
    const OrbitPool orbit_pool(grid, pool, orbits.mirrors);
    const int moves = orbits.moves > 0 ? orbits.moves : 100 * (2 * l + 1) * (2 * l + 1);
    std::vector<Island> islands;
    for (int i = 0; i < settings.islands; ++i)
        islands.emplace_back(l, grid, orbit_pool, settings, moves, emitted_cost, i);
    SearchResult result;
    double best_cost = std::numeric_limits<double>::infinity();
    const auto take = [&](const Measured& measured) {
        best_cost = measured.cost;
        result.best = measured.solution;
        course.progress.instructions = measured.instructions;
    };
    if (start) {
        const std::optional<OrbitSet> whole = orbit_pool.orbits_of(*start);
        if (!whole) throw std::invalid_argument("lobes that are not closed under these mirrors");
        for (Island& island : islands) island.adopt(*whole);
        take(islands.front().best());
    }
    do {
        tbb::parallel_for(0, settings.islands,
                          [&](int i) { islands[i].step([&] { return course.is_stopped(); }); });
        std::int64_t evaluations = 0;
        bool has_better = false;
        for (const Island& island : islands) {
            evaluations += island.evaluations();
            if (!(island.best().cost < best_cost)) continue;
            take(island.best());
            has_better = true;
        }
        course.finish_generation(result.best, has_better, evaluations);
        if (has_better) observer.on_better(result.best, course.progress);
        observer.on_generation(course.progress);
        if (evaluations == 0 && result.best.lobes.empty())
            break;  // there are no regular orbits to begin from
    } while (!course.is_over());
    result.progress = course.progress;
    return result;
}

}  // namespace zonal::search
