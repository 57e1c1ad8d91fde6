#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>

#include "search/refine.hpp"

namespace zonal::search {

/// Where a search stands after a generation.
struct Progress {
    int generation = 0;
    int generations = 0;   ///< wanted; 0 when not known
    Score best;            ///< at 50 digits
    int instructions = 0;  ///< of the best's emitted product, in a search that counts them; else 0
    std::int64_t evaluations = 0;
    double seconds = 0;       ///< since the start
    double seconds_left = 0;  ///< an estimate; 0 when not known
};

/// Called between generations, in the caller's thread.
struct SearchObserver {
    std::function<void(const Progress&)> on_generation = [](const Progress&) {};
    std::function<void(const Solution&, const Progress&)> on_better = [](const Solution&, const Progress&) {};
};

/// When a search ends.
struct Limits {
    int generations = 0;        ///< 0: no limit
    double seconds = 0;         ///< 0: no limit
    int stall_generations = 0;  ///< without improvement, where neither of the others is given
};

/// The course of a search through its generations. Time begins with the object.
class Course {
  public:
    Course(const Limits& limits, const std::atomic<bool>& stop);

    /// Told to stop, or out of time: the present generation should end early.
    bool is_stopped() const;

    /// Ends a generation. `evaluations`: since the start.
    void finish_generation(const Solution& best, bool has_better, std::int64_t evaluations);

    bool is_over() const;

    Progress progress;

  private:
    double seconds() const;

    Limits limits_;
    const std::atomic<bool>* stop_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    int stalled_ = 0;
};

}  // namespace zonal::search
