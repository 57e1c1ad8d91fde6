#include "search/course.hpp"

#include <algorithm>

namespace zonal::search {

Course::Course(const Limits& limits, const std::atomic<bool>& stop) : limits_(limits), stop_(&stop) {
    progress.generations = limits.generations;
}

double Course::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

bool Course::is_stopped() const { return *stop_ || (limits_.seconds > 0 && seconds() >= limits_.seconds); }

void Course::finish_generation(const Solution& best, bool has_better, std::int64_t evaluations) {
    ++progress.generation;
    stalled_ = has_better ? 0 : stalled_ + 1;
    progress.best = best.score;
    progress.evaluations = evaluations;
    progress.seconds = seconds();
    const double by_generations =
        progress.seconds / progress.generation * (limits_.generations - progress.generation);
    const double by_time = limits_.seconds - progress.seconds;
    progress.seconds_left = std::max(0.0, limits_.generations == 0 ? by_time
                                          : limits_.seconds == 0   ? by_generations
                                                                   : std::min(by_generations, by_time));
}

bool Course::is_over() const {
    const bool has_limits = limits_.generations > 0 || limits_.seconds > 0;
    return *stop_ || (limits_.seconds > 0 && progress.seconds >= limits_.seconds) ||
           (limits_.generations > 0 && progress.generation >= limits_.generations) ||
           (!has_limits && stalled_ >= limits_.stall_generations);
}

}  // namespace zonal::search
