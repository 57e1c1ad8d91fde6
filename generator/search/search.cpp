// The whole search: islands breed in parallel, one generation at a time; each confirms and refines those of
// its best sets that it has not met before. A set that gained off the grid breeds on, and its new angles
// become candidates for all: at order 7 that took a minute's search from 230 nonzeros to 219. Every few
// generations the best of an island moves on to the next; an island that has stalled begins anew. Nothing
// depends on time but when the search ends.

#include "search/search.hpp"

#include <tbb/parallel_for.h>

#include <chrono>
#include <cmath>
#include <set>
#include <utility>

namespace zonal::search {
namespace {

/// A set this much dearer than the best may still overtake it off the grid.
constexpr double kWorthRefining = 12;
constexpr int kRefinedInAGeneration = 6;

bool is_better(const Solution& a, const Solution& b, const Objective& objective) {
    const double cost_a = a.score.cost(objective), cost_b = b.score.cost(objective);
    if (std::isinf(cost_a)) return false;
    if (std::isinf(cost_b) || std::abs(cost_a - cost_b) > 1e-6) return cost_a < cost_b;
    return turning_cost(directions_of(a.lobes)) < turning_cost(directions_of(b.lobes));
}

class Island {
  public:
    Island(const Problem& problem, const CandidateGrid& grid, const SearchSettings& settings, int index,
           const std::optional<LobeSet>& start)
        : problem_(&problem),
          grid_(&grid),
          settings_(&settings),
          population_(problem, grid, settings.objective, settings.genetic, Random(settings.seed, index)) {
        if (start) population_.adopt(*start);
    }

    void step(const std::atomic<bool>& stop) {
        if (population_.has_stalled()) population_.restart();
        population_.evolve();
        confirm_new_sets(stop);
    }

    void receive(const LobeSet& lobes) { population_.adopt(lobes); }

    /// The sets that left the grid since the last call.
    std::vector<AngledSet> take_refined() { return std::exchange(refined_, {}); }

    const Population& population() const { return population_; }
    const Solution& best() const { return best_; }

  private:
    /// Sets of one cost are nearly always images of each other, so a cost is looked at once.
    void confirm_new_sets(const std::atomic<bool>& stop) {
        const double worst = population_.best().cost + kWorthRefining;
        int count = 0;
        for (const Individual& individual : population_.best_of_each_cost(settings_->genetic.population)) {
            if (individual.cost > worst || count == kRefinedInAGeneration) break;
            const auto key = std::llround(individual.cost * 1e6);
            if (!confirmed_costs_.insert(key).second) continue;
            ++count;
            Solution solution = confirm(*problem_, with_angles(*grid_, individual.lobes));
            if (settings_->leaves_grid) {
                const double cost_on_grid = solution.score.cost(settings_->objective);
                solution = refine(*problem_, settings_->objective, solution, [&] { return stop.load(); });
                if (solution.score.cost(settings_->objective) < cost_on_grid)
                    refined_.push_back(solution.lobes);
            }
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
};

/// Passes the best set of every island on to the next one.
void exchange(std::vector<Island>& islands) {
    std::vector<LobeSet> travellers;
    for (const Island& island : islands) travellers.push_back(island.population().best().lobes);
    for (std::size_t i = 0; i < islands.size(); ++i) {
        islands[(i + 1) % islands.size()].receive(travellers[i]);
    }
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The set on the grid, to which angles of its own are added.
LobeSet put_on_grid(CandidateGrid& grid, const AngledSet& set) {
    LobeSet lobes;
    for (const AngledLobe& lobe : set) {
        lobes.push_back(grid.canonical(grid.add_theta(lobe.theta), grid.add_phi(lobe.phi)));
    }
    return lobes;
}

}  // namespace

SearchResult search_lobes(const Problem& problem, const SearchSettings& settings,
                          const std::atomic<bool>& stop, const SearchObserver& observer) {
    const auto start_time = std::chrono::steady_clock::now();
    CandidateGrid grid(problem.highest_band(), settings.zero_bands);
    SearchResult result;
    std::optional<LobeSet> start;
    if (settings.start) {
        start = put_on_grid(grid, *settings.start);
        result.best = confirm(problem, *settings.start);
    }
    std::vector<Island> islands;
    for (int i = 0; i < settings.islands; ++i) islands.emplace_back(problem, grid, settings, i, start);

    Progress& progress = result.progress;
    progress.generations = settings.generations;
    int stalled = 0;
    while (true) {
        tbb::parallel_for(0, settings.islands, [&](int i) { islands[i].step(stop); });
        // One after another, so that the grid grows in the same way every time.
        for (Island& island : islands) {
            for (const AngledSet& set : island.take_refined()) island.receive(put_on_grid(grid, set));
        }
        ++progress.generation;
        ++stalled;
        progress.evaluations = 0;
        bool has_better = false;
        for (const Island& island : islands) {
            progress.evaluations += island.population().evaluations();
            if (!is_better(island.best(), result.best, settings.objective)) continue;
            result.best = island.best();
            has_better = true;
            stalled = 0;
        }
        // Angles that came back to a candidate take its closed form.
        if (has_better) result.best.lobes = with_angles(grid, put_on_grid(grid, result.best.lobes));
        if (progress.generation % settings.generations_between_exchanges == 0) exchange(islands);

        progress.best = result.best.score;
        progress.seconds = seconds_since(start_time);
        const double by_generations =
            progress.seconds / progress.generation * (settings.generations - progress.generation);
        const double by_time = settings.seconds - progress.seconds;
        progress.seconds_left = std::max(0.0, settings.generations == 0 ? by_time
                                              : settings.seconds == 0   ? by_generations
                                                                        : std::min(by_generations, by_time));
        if (has_better) observer.on_better(result.best, progress);
        observer.on_generation(progress);

        const bool is_out_of_time = settings.seconds > 0 && progress.seconds >= settings.seconds;
        const bool has_run_its_generations =
            settings.generations > 0 && progress.generation >= settings.generations;
        const bool is_told_when_to_end = settings.generations > 0 || settings.seconds > 0;
        const bool has_stalled = !is_told_when_to_end && stalled >= settings.genetic.stall_generations;
        if (stop || is_out_of_time || has_run_its_generations || has_stalled) return result;
    }
}

}  // namespace zonal::search
