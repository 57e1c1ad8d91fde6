#pragma once

// The walk where neighbours in memory are lanes: vectors of planes, or the channels of one vector. Nothing is
// transposed.

#include "copies.hpp"

namespace zonal::batch {
namespace {

/// Whether the interleaved channels of one vector are enough for packs.
template <class T>
HWY_INLINE bool can_fill_packs(const Job<T>& job) {
    return job.channels >= 8 && job.channels >= kLanes<T>;
}

/// Whether they fill packs well enough, or better than its vectors would.
template <class T>
HWY_INLINE bool fill_packs(const Job<T>& job) {
    const std::size_t whole = (job.channels + kLanes<T> - 1) / kLanes<T> * kLanes<T>;
    return can_fill_packs(job) && (4 * whole <= 5 * job.channels || job.count < kLanes<T>);
}

/// Neighbours in one array of each coefficient: value k of coefficient i is planes[i][begin + k].
template <class T, int N>
struct Planes {
    static constexpr std::size_t kStep = kLanes<T>;  ///< neighbours in a pack

    const T* const* in;
    T* const* out;
    std::size_t in_begin, out_begin;
    int first;  ///< the first coefficient: 1 where band 0 is apart

    HWY_INLINE Lanes<T> read(int i, std::size_t k) const { return hn::LoadU(Tag<T>(), in[i] + in_begin + k); }
    HWY_INLINE void write(int i, std::size_t k, Lanes<T> lanes) const {
        hn::StoreU(lanes, Tag<T>(), out[i] + out_begin + k);
    }
};

/// Interleaved channels of one vector.
template <class T, int N>
struct Channels {
    static constexpr std::size_t kStep = kLanes<T>;

    const T* in;
    T* out;
    std::size_t channels;
    int first;

    HWY_INLINE Lanes<T> read(int i, std::size_t k) const {
        return hn::LoadU(Tag<T>(), in + static_cast<std::size_t>(i - first) * channels + k);
    }
    HWY_INLINE void write(int i, std::size_t k, Lanes<T> lanes) const {
        hn::StoreU(lanes, Tag<T>(), out + static_cast<std::size_t>(i - first) * channels + k);
    }
};

/// Turns `length` >= Side::kStep neighbours of each coefficient; with rotations of their own one for each.
/// A few packs are read before any of them is written, coefficient by coefficient: arrays whose distance is a
/// power of two push each other's lines out of the first cache, so that every line is met once only. What is
/// left over by whole steps is turned in a pack that overlaps another of those few: so input and output may
/// be the same.
template <class Turn, class Side, class T>
HWY_NOINLINE void turn_neighbours(const Job<T>& job, const Turn& turn, const Side& side, std::size_t length) {
    constexpr int N = Turn::kOrder;
    constexpr std::size_t kFitting = kMostBytes / (2 * N * N * sizeof(Pack<T>));
    constexpr std::size_t kTogether = kFitting < 2 ? 2 : kFitting < 4 ? kFitting : 4;
    Pack<T> f[kTogether][N * N];
    const std::size_t last = length - Side::kStep;
    std::size_t left = (length + Side::kStep - 1) / Side::kStep;
    for (std::size_t begin = 0; left > 0;) {
        // Never one alone at the end: it would overlap what is written already.
        const std::size_t count = left == kTogether + 1 ? kTogether - 1 : left < kTogether ? left : kTogether;
        std::size_t places[kTogether];
        for (std::size_t t = 0; t < count; ++t) {
            places[t] = begin < last ? begin : last;
            begin += Side::kStep;
        }
        left -= count;
        for (int i = side.first; i < N * N; ++i)
            for (std::size_t t = 0; t < count; ++t) f[t][i].lanes = side.read(i, places[t]);
        for (std::size_t t = 0; t < count; ++t) {
            if (side.first == 1) f[t][0].lanes = hn::Zero(Tag<T>());
            if constexpr (Turn::kUse == Use::one_channel) {
                Turn own;
                Pack<T> R[9];
                load_rotations<false>(job, job.rotations + places[t] * job.rotation_stride, R);
                take_called(own, R, job.form);
                turn_shared(job, own, f[t]);
            } else {
                turn_shared(job, turn, f[t]);
            }
        }
        for (int i = side.first; i < N * N; ++i)
            for (std::size_t t = 0; t < count; ++t) side.write(i, places[t], f[t][i].lanes);
    }
}

/// Vectors of one channel that touch in every plane.
template <class Turn, class T>
void turn_planar(const Job<T>& job, Turn& turn) {
    const bool is_touching = job.channels == 1 && job.in_stride == 1 && job.out_stride == 1;
    if (!is_touching || job.count < kLanes<T>) return turn_copies(job, turn, 0);
    const Planes<T, Turn::kOrder> planes{job.in_planes, job.out_planes, job.in_begin, job.out_begin,
                                         job.is_dc_apart ? 1 : 0};
    turn_neighbours(job, turn, planes, job.count);
}

/// All channels of vector k, where they fill packs.
template <class T, int N>
HWY_INLINE void turn_channels(const Job<T>& job, const Prepared<T, N, Use::all_vectors>& turn,
                              std::size_t k) {
    const Channels<T, N> channels{job.in + k * job.in_stride, job.out + k * job.out_stride, job.channels,
                                  job.is_dc_apart ? 1 : 0};
    turn_neighbours(job, turn, channels, job.channels);
}

/// Many interleaved channels by one rotation, of the vectors from k on.
template <class T, int N>
void turn_across(const Job<T>& job, const Prepared<T, N, Use::all_vectors>& turn, std::size_t k) {
    for (; k < job.count; ++k) turn_channels(job, turn, k);
}

/// The same with a rotation each, prepared for a pack of vectors at a time.
template <class T, int N>
void turn_across(const Job<T>& job, Prepared<T, N, Use::channels>& turn, std::size_t k) {
    Prepared<T, N, Use::all_vectors> one;
    for (; k < job.count; k += kLanes<T>) {
        const std::size_t live = job.count - k < kLanes<T> ? job.count - k : kLanes<T>;
        Pack<T> R[9];
        gather_rotations(job, k, live, R);
        take_called(turn, R, job.form);
        for (std::size_t lane = 0; lane < live; ++lane) {
            one.broadcast(turn, lane);
            turn_channels(job, one, k + lane);
        }
    }
}

}  // namespace
}  // namespace zonal::batch
