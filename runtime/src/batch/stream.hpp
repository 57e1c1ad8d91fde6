#pragma once

// Writes one long run of values past the caches, whatever its alignment: values are staged in memory that
// stays in cache, at their distance from a cache line, and leave it as whole lines. The ends of the run,
// which share a line with foreign values, are written by ordinary stores. What was staged leaves one step
// later: then it is read back without waiting for the stores that put it there, and writing to memory goes on
// beside reading instead of in bursts between.

#include <hwy/cache_control.h>

#include <cstdint>

#include "pack.hpp"

namespace zonal::batch {
namespace {

/// kRoom: the most values that are staged in one step.
template <class T, std::size_t kRoom>
class Stream {
  public:
    explicit Stream(T* out)
        : foreign_(reinterpret_cast<std::uintptr_t>(out) % kLineBytes / sizeof(T)),
          line_(out - foreign_),
          fill_(foreign_) {}

    /// Where the next values, kRoom at most, are to be put.
    HWY_INLINE T* room() { return stage_[current_] + fill_; }

    /// `count` values have been put there.
    HWY_INLINE void advance(std::size_t count) {
        write_waiting();
        fill_ += count;
        const std::size_t whole = fill_ - fill_ % kLine;
        waiting_ = whole;
        waiting_line_ = line_;
        line_ += whole;
        fill_ -= whole;
        const T* rest = stage_[current_] + whole;
        current_ ^= 1;
        for (std::size_t j = 0; j < kLine; j += kLanes<T>)
            hn::Store(hn::Load(Tag<T>(), rest + j), Tag<T>(), stage_[current_] + j);
    }

    void finish() {
        write_waiting();
        for (std::size_t i = foreign_; i < fill_; ++i) line_[i] = stage_[current_][i];
        hwy::FlushStream();
    }

  private:
    static constexpr std::size_t kLineBytes = 64;
    static constexpr std::size_t kLine = kLineBytes / sizeof(T);

    /// Whole lines in the stage that is not current.
    HWY_INLINE void write_waiting() {
        const T* stage = stage_[current_ ^ 1];
        std::size_t i = 0;
        if (HWY_UNLIKELY(foreign_ > 0 && waiting_ > 0)) {
            for (std::size_t j = foreign_; j < kLine; ++j) waiting_line_[j] = stage[j];
            foreign_ = 0;
            i = kLine;
        }
        for (; i < waiting_; i += kLine)
            for (std::size_t j = 0; j < kLine; j += kLanes<T>)
                hn::Stream(hn::Load(Tag<T>(), stage + i + j), Tag<T>(), waiting_line_ + i + j);
        waiting_ = 0;
    }

    alignas(kLineBytes) T stage_[2][(kRoom + 3 * kLine) / kLine * kLine];
    std::size_t foreign_;  ///< values of the first line that are not of the run; 0 once it is written
    T* line_;              ///< the place of the current stage's first value
    std::size_t fill_;     ///< values in the current stage
    int current_ = 0;
    T* waiting_line_ = nullptr;  ///< the same of the other stage
    std::size_t waiting_ = 0;    ///< values that wait there
};

}  // namespace
}  // namespace zonal::batch
