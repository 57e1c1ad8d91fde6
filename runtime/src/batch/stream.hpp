#pragma once

// Writes one long run of values past the caches, whatever its alignment: values are staged in memory that
// stays in cache, at their distance from a cache line, and leave it as whole lines. The ends of the run,
// which share a line with foreign values, are written by ordinary stores.

#include <hwy/cache_control.h>

#include <cstdint>

#include "pack.hpp"

namespace zonal::batch {
namespace {

/// kRoom: the most values that are staged at once.
template <class T, std::size_t kRoom>
class Stream {
  public:
    explicit Stream(T* out)
        : foreign_(reinterpret_cast<std::uintptr_t>(out) % 64 / sizeof(T)),
          line_(out - foreign_),
          fill_(foreign_) {}

    /// Where the next values, kRoom at most, are to be put.
    T* room() { return stage_ + fill_; }

    /// `count` values have been put there.
    HWY_INLINE void advance(std::size_t count) {
        fill_ += count;
        if (fill_ >= kEnough) flush();
    }

    void finish() {
        flush();
        for (std::size_t i = foreign_; i < fill_; ++i) line_[i] = stage_[i];
        hwy::FlushStream();
    }

  private:
    static constexpr std::size_t kLine = 64 / sizeof(T);
    // Many lines at a time: the first are read back long after they were staged, and writing to memory comes
    // in bursts.
    static constexpr std::size_t kEnough = 4096 / sizeof(T);

    void flush() {
        std::size_t i = 0;
        if (foreign_ > 0 && fill_ >= kLine) {
            for (std::size_t j = foreign_; j < kLine; ++j) line_[j] = stage_[j];
            foreign_ = 0;
            i = kLine;
        }
        for (; i + kLine <= fill_; i += kLine)
            for (std::size_t j = 0; j < kLine; j += kLanes<T>)
                hn::Stream(hn::Load(Tag<T>(), stage_ + i + j), Tag<T>(), line_ + i + j);
        if (i == 0) return;
        for (std::size_t j = 0; j < kLine; j += kLanes<T>)
            hn::Store(hn::Load(Tag<T>(), stage_ + i + j), Tag<T>(), stage_ + j);
        line_ += i;
        fill_ -= i;
    }

    alignas(64) T stage_[kEnough + kRoom + 2 * kLine];
    std::size_t foreign_;  ///< values of the first line that are not of the run; 0 from the second line on
    T* line_;              ///< the place of stage_[0]
    std::size_t fill_;
};

}  // namespace
}  // namespace zonal::batch
