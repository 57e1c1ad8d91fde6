#pragma once

// Writes one long run of values past the caches, whatever its alignment: values are staged in memory that
// stays in cache, at their distance from a cache line, and leave it as whole lines. The ends of the run,
// which share a line with foreign values, are written by ordinary stores. What was staged leaves during the
// next step, a few lines at a time between its other work: then it is read back without waiting for the
// stores that put it there, and writing to memory goes on beside reading instead of in bursts.

#include <hwy/cache_control.h>

#include <cstddef>
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
    HWY_INLINE T* room() { return stage(current_) + fill_; }

    /// `count` values have been put there.
    HWY_INLINE void advance(std::size_t count) {
        write_waiting();
        fill_ += count;
        const std::size_t whole = fill_ - fill_ % kLine;
        waiting_ = stage(current_);
        waiting_line_ = line_;
        next_ = 0;
        end_ = whole;
        if (HWY_UNLIKELY(foreign_ > 0 && whole > 0)) write_shared_line();
        line_ += whole;
        fill_ -= whole;
        const T* rest = stage(current_) + whole;
        current_ ^= 1;
        for (std::size_t j = 0; j < kLine; j += kLanes<T>)
            hn::Store(hn::Load(Tag<T>(), rest + j), Tag<T>(), stage(current_) + j);
    }

    /// Writes kCount of the values that wait, whole lines, if there are as many.
    template <std::size_t kCount>
    HWY_INLINE void write_some() {
        if (end_ - next_ >= kCount) write_lines<kCount>();
    }

    HWY_INLINE void write_waiting() {
        while (next_ < end_) write_lines<kLine>();
    }

    void finish() {
        write_waiting();
        for (std::size_t i = foreign_; i < fill_; ++i) line_[i] = stage(current_)[i];
        hwy::FlushStream();
    }

    static constexpr std::size_t kLineBytes = 64;
    static constexpr std::size_t kLine = kLineBytes / sizeof(T);

  private:
    template <std::size_t kCount>
    HWY_INLINE void write_lines() {
        static_assert(kCount % kLine == 0);
        const T* const from = waiting_ + next_;
        T* const to = waiting_line_ + next_;
        for (std::size_t i = 0; i < kCount; i += kLanes<T>)
            hn::Stream(hn::Load(Tag<T>(), from + i), Tag<T>(), to + i);
        next_ += kCount;
    }

    /// The first line of the run, which begins with values that are not of the run.
    HWY_NOINLINE void write_shared_line() {
        for (std::size_t j = foreign_; j < kLine; ++j) line_[j] = stage(current_)[j];
        foreign_ = 0;
        next_ += kLine;
    }

    /// The stages have pages of their own: one that goes across the end of a page costs a batch up to a third
    /// more time (Zen 4, order 6). The second begins some lines later: while one is filled the other leaves,
    /// and a load from the same place of another page can be made to wait for a store.
    static constexpr std::size_t kPage = 4096 / sizeof(T);
    static constexpr std::size_t kSecondBegins = 13 * kLine;
    static constexpr std::size_t kPages = (kSecondBegins + kRoom + 3 * kLine + kPage - 1) / kPage;

    HWY_INLINE T* stage(int index) { return stages_[index] + (index == 0 ? 0 : kSecondBegins); }

    alignas(4096) T stages_[2][kPages * kPage];
    std::size_t foreign_;  ///< values of the first line that are not of the run; 0 once it is written
    T* line_;              ///< the place of the current stage's first value
    std::size_t fill_;     ///< values in the current stage
    int current_ = 0;

    // What waits in the other stage, and its place. While it leaves, one number changes and no more: a
    // compiler changes two that lie side by side by one vector instruction, whose load then waits until the
    // two stores that wrote them have left the queue, behind those to memory.
    const T* waiting_ = nullptr;
    T* waiting_line_ = nullptr;
    std::size_t next_ = 0;  ///< the first value of the next line
    std::size_t end_ = 0;   ///< behind the last
};

/// Where a walk writes, step by step: a stream, or memory as it is.
template <class T, std::size_t kRoom>
class Output {
  public:
    using Values = Stream<T, kRoom>;

    HWY_INLINE explicit Output(T* out, Values* stream = nullptr) : out_(out), stream_(stream) {}

    /// Where the values of this step are to be put.
    HWY_INLINE T* room() const { return stream_ != nullptr ? stream_->room() : out_; }
    /// They have been put there: as many as the next step's are behind these.
    HWY_INLINE void advance(std::size_t count) {
        if (stream_ != nullptr) stream_->advance(count);
        out_ += count;
    }
    /// Time for kCount of the values that wait, whole lines, to leave.
    template <std::size_t kCount>
    HWY_INLINE void write_some() const {
        if (HWY_LIKELY(stream_ != nullptr)) stream_->template write_some<kCount>();
    }
    HWY_INLINE void finish() const {
        if (stream_ != nullptr) stream_->finish();
    }

  private:
    T* out_;
    Values* stream_;
};

}  // namespace
}  // namespace zonal::batch
