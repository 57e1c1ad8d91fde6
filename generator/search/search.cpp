// The whole search: islands breed in parallel, one generation at a time; each confirms and refines those of
// its best sets that it has not met before. A set that gained off the grid breeds on, and its new angles
// become candidates for all. Every few generations the best of an island moves on to the next; an island that
// has stalled begins anew. Nothing depends on time but when the search ends.

#include "search/search.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "search/front.hpp"

namespace zonal::search {
namespace {

/// A set this much dearer than the best may still overtake it off the grid. Of many lobes, where a walk off
/// the grid takes many seconds, only those walk that are the best so far.
constexpr double kWorthRefining = 12;
constexpr int kManyLobes = 21;
constexpr int kRefinedInAGeneration = 2;

class Island {
  public:
    Island(const Problem& problem, const CandidateGrid& grid, const Pool& pool,
           const SearchSettings& settings, int index, const std::optional<LobeSet>& start)
        : problem_(&problem),
          grid_(&grid),
          settings_(&settings),
          population_(problem, grid, pool, settings.objective, settings.genetic,
                      Random(settings.seed, index)) {
        if (start) population_.adopt(*start);
    }

    void step(const std::function<bool()>& is_stopped) {
        if (population_.has_stalled()) population_.restart();
        population_.evolve(is_stopped);
        confirm_new_sets(is_stopped);
    }

    void receive(const LobeSet& lobes) { population_.adopt(lobes); }

    /// The sets that left the grid since the last call.
    std::vector<AngledSet> take_refined() { return std::exchange(refined_, {}); }

    const Population& population() const { return population_; }
    const Solution& best() const { return best_; }
    const std::vector<Solution>& front() const { return front_; }

  private:
    /// Sets of one cost are nearly always images of each other, so a cost is looked at once.
    void confirm_new_sets(const std::function<bool()>& is_stopped) {
        const double worst = population_.best().cost + kWorthRefining;
        int count = 0;
        for (const Individual& individual : population_.best_of_each_cost(settings_->genetic.population)) {
            if (individual.cost > worst || count == kRefinedInAGeneration) break;
            const auto key = std::llround(individual.cost * 1e6);
            if (!confirmed_costs_.insert(key).second) continue;
            ++count;
            Solution solution = confirm(*problem_, with_angles(*grid_, individual.lobes));
            const bool may_walk =
                problem_->lobe_count <= kManyLobes || is_better(solution, best_, settings_->objective);
            if (settings_->leaves_grid && may_walk) {
                const double cost_on_grid = solution.score.cost(settings_->objective);
                solution = refine(*problem_, settings_->objective, solution, is_stopped);
                if (solution.score.cost(settings_->objective) < cost_on_grid)
                    refined_.push_back(solution.lobes);
            }
            if (solution.score.is_allowed(settings_->objective)) add_to_front(front_, solution);
            if (is_better(solution, best_, settings_->objective)) best_ = solution;
        }
    }

    const Problem* problem_;
    const CandidateGrid* grid_;
    const SearchSettings* settings_;
    Population population_;
    std::set<long long> confirmed_costs_;
    std::vector<AngledSet> refined_;
    Solution best_;
    std::vector<Solution> front_;
};

/// Passes the best set of every island on to the next one.
void exchange(std::vector<Island>& islands) {
    std::vector<LobeSet> travellers;
    for (const Island& island : islands) travellers.push_back(island.population().best().lobes);
    for (std::size_t i = 0; i < islands.size(); ++i) {
        islands[(i + 1) % islands.size()].receive(travellers[i]);
    }
}

}  // namespace

SearchResult search_lobes(const Problem& problem, const SearchSettings& settings,
                          const std::atomic<bool>& stop, const SearchObserver& observer) {
    Course course({settings.generations, settings.seconds, settings.genetic.stall_generations}, stop);
    CandidateGrid grid(problem.highest_band(),
                       settings.zero_bands.empty() ? usual_zero_bands(problem.bands) : settings.zero_bands);
    Pool pool(grid, settings.rings.empty() ? usual_rings(problem.bands) : settings.rings);
    SearchResult result;
    std::optional<LobeSet> start;
    if (settings.start) {
        start = put_on_grid(grid, *settings.start);
        result.best = confirm(problem, *settings.start);
    }
    std::vector<Island> islands;
    for (int i = 0; i < settings.islands; ++i) islands.emplace_back(problem, grid, pool, settings, i, start);

    const auto is_stopped = [&] { return course.is_stopped(); };
    do {
        tbb::parallel_for(0, settings.islands, [&](int i) { islands[i].step(is_stopped); });
        // One after another, so that the grid grows in the same way every time.
        for (Island& island : islands) {
            for (const AngledSet& set : island.take_refined()) {
                const LobeSet lobes = put_on_grid(grid, set);
                for (const Lobe lobe : lobes) pool.add(lobe);
                island.receive(lobes);
            }
        }
        std::int64_t evaluations = 0;
        bool has_better = false;
        for (const Island& island : islands) {
            evaluations += island.population().evaluations();
            if (!is_better(island.best(), result.best, settings.objective)) continue;
            result.best = island.best();
            has_better = true;
        }
        // Angles that came back to a candidate take its closed form.
        if (has_better) result.best.lobes = with_angles(grid, put_on_grid(grid, result.best.lobes));
        course.finish_generation(result.best, has_better, evaluations);
        if (course.progress.generation % settings.generations_between_exchanges == 0) exchange(islands);
        if (has_better) observer.on_better(result.best, course.progress);
        observer.on_generation(course.progress);
    } while (!course.is_over());
    result.progress = course.progress;
    for (const Island& island : islands)
        for (const Solution& solution : island.front()) add_to_front(result.front, solution);
    sort_front(result.front);
    return result;
}

}  // namespace zonal::search
