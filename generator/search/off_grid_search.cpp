#include "search/off_grid_search.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "search/angle_walk.hpp"
#include "search/front.hpp"
#include "search/polish.hpp"

namespace zonal::search {
namespace {

/// About a second of moves, by trial.
int usual_moves(const Problem& problem) {
    const double lobes = problem.lobe_count;
    return std::max(20, static_cast<int>(1e6 / (lobes * lobes * lobes)));
}

/// Walkers from cold to warm, in nonzeros.
double temperature_of(int island) { return 0.35 * std::pow(std::sqrt(2.0), island % 4); }

class Walker {
  public:
    Walker(const Problem& problem, const SearchSettings& settings, int moves, const Solution& start,
           int island)
        : problem_(&problem),
          moves_(moves),
          objective_(settings.objective),
          walk_(problem, settings.objective, temperature_of(island), Random(settings.seed, island)) {
        begin_at(start);
    }

    void begin_at(const Solution& solution) {
        best_ = solution;
        walk_.start_from(best_.lobes);
    }

    void step(const std::function<bool()>& is_stopped) {
        for (int move = 0; move < moves_ && !is_stopped(); ++move) {
            walk_.move();
            if (walk_.best().cost < best_.score.cost(objective_) - kWorthwhile) confirm_best();
        }
    }

    const Solution& best() const { return best_; }
    const std::vector<Solution>& front() const { return front_; }
    std::int64_t evaluations() const { return walk_.evaluations(); }

  private:
    /// What 50 digits do not confirm, the walk forgets.
    void confirm_best() {
        const auto polished = polish_moved(*problem_, best_.lobes, walk_.best().angles, walk_.best().zeros);
        if (polished) {
            const Solution solution = confirm(*problem_, *polished);
            if (solution.score.is_allowed(objective_)) add_to_front(front_, solution);
            if (is_better(solution, best_, objective_)) best_ = solution;
        }
        walk_.start_from(best_.lobes);
    }

    const Problem* problem_;
    int moves_;
    Objective objective_;
    AngleWalk walk_;
    Solution best_;
    std::vector<Solution> front_;
};

/// All Legendre zeros of the bands up to the highest.
CandidateGrid grid_for(const Problem& problem) {
    std::vector<int> zero_bands(problem.highest_band());
    std::iota(zero_bands.begin(), zero_bands.end(), 1);
    return CandidateGrid(problem.highest_band(), zero_bands);
}

}  // namespace

SearchResult search_off_grid(const Problem& problem, const SearchSettings& settings, int moves,
                             const std::atomic<bool>& stop, const SearchObserver& observer) {
    Course course({settings.generations, settings.seconds, settings.genetic.stall_generations}, stop);
    SearchResult result;
    result.best = confirm(problem, settings.start.value());
    if (result.best.score.is_allowed(settings.objective)) add_to_front(result.front, result.best);
    CandidateGrid grid = grid_for(problem);
    std::vector<Walker> walkers;
    if (moves == 0) moves = usual_moves(problem);
    for (int i = 0; i < settings.islands; ++i) walkers.emplace_back(problem, settings, moves, result.best, i);
    do {
        tbb::parallel_for(0, settings.islands,
                          [&](int i) { walkers[i].step([&] { return course.is_stopped(); }); });
        std::int64_t evaluations = 0;
        bool has_better = false;
        for (const Walker& walker : walkers) {
            evaluations += walker.evaluations();
            if (!is_better(walker.best(), result.best, settings.objective)) continue;
            result.best = walker.best();
            has_better = true;
        }
        // Angles that came to a Legendre zero or to a fraction of pi take its closed form.
        if (has_better) result.best.lobes = with_angles(grid, put_on_grid(grid, result.best.lobes));
        course.finish_generation(result.best, has_better, evaluations);
        if (course.progress.generation % settings.generations_between_exchanges == 0)
            for (Walker& walker : walkers) walker.begin_at(result.best);
        if (has_better) observer.on_better(result.best, course.progress);
        observer.on_generation(course.progress);
    } while (!course.is_over());
    result.progress = course.progress;
    for (const Walker& walker : walkers)
        for (const Solution& solution : walker.front()) add_to_front(result.front, solution);
    sort_front(result.front);
    return result;
}

}  // namespace zonal::search
