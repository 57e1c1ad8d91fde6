#pragma once

// The walk for what fills no pack, and for layouts in which neither coefficients nor vectors touch: values go
// one by one through a copy on the stack, a lane a vector.

#include "turns.hpp"

namespace zonal::batch {
namespace {

/// `count` values of each of `live` <= kLanes vectors to packs: value i of vector k is at(i)[k * stride].
/// In the lanes beyond, bit i of `ones` is the value.
template <class T, class At>
HWY_INLINE void gather(const At& at, std::size_t stride, std::size_t count, std::size_t live, unsigned ones,
                       Pack<T>* packs) {
    HWY_ALIGN T lanes[kLanes<T>];
    for (std::size_t i = 0; i < count; ++i) {
        const T* const values = at(i);
        const T dead = static_cast<T>(i < 9 ? ones >> i & 1 : 0);  // a rotation has nine at most
        if (live == 1) {
            packs[i].lanes = hn::Set(Tag<T>(), values[0]);
            continue;
        }
        hn::Store(hn::Set(Tag<T>(), dead), Tag<T>(), lanes);
        for (std::size_t k = 0; k < live; ++k) lanes[k] = values[k * stride];
        packs[i].lanes = hn::Load(Tag<T>(), lanes);
    }
}

/// The reverse.
template <class T, class At>
HWY_INLINE void scatter(const Pack<T>* packs, const At& at, std::size_t stride, std::size_t count,
                        std::size_t live) {
    HWY_ALIGN T lanes[kLanes<T>];
    for (std::size_t i = 0; i < count; ++i) {
        T* const values = at(i);
        if (live == 1) {
            values[0] = hn::GetLane(packs[i].lanes);
            continue;
        }
        hn::Store(packs[i].lanes, Tag<T>(), lanes);
        for (std::size_t k = 0; k < live; ++k) values[k * stride] = lanes[k];
    }
}

/// The rotations of vectors k ... k + live - 1; the lanes beyond get the identity.
template <class T>
HWY_NOINLINE void gather_rotations(const Job<T>& job, std::size_t k, std::size_t live, Pack<T>* R) {
    const T* const values = job.rotations + k * job.rotation_stride;
    const auto at = [values](std::size_t i) { return values + i; };
    if (job.form == RotationForm::matrix) {
        gather(at, job.rotation_stride, 9, live, 0x111, R);
    } else {
        Pack<T> q[4];
        gather(at, job.rotation_stride, 4, live, job.form == RotationForm::quaternion_xyzw ? 8 : 1, q);
        matrices_of(q, job.form, R);
    }
    if (job.matrix_form != nullptr) bring_to_form(*job.matrix_form, R);
}

/// Reads and writes one channel of vectors k ... k + live - 1.
template <class T>
HWY_NOINLINE void gather_channel(const Job<T>& job, std::size_t coefficients, std::size_t k,
                                 std::size_t channel, std::size_t live, Pack<T>* f) {
    const std::size_t first = job.is_dc_apart ? 1 : 0;
    const std::size_t count = coefficients - first;
    if (first == 1) f[0].lanes = hn::Zero(Tag<T>());
    if (job.shape == Shape::planes) {
        const std::size_t offset = job.in_begin + k * job.in_stride + channel;
        return gather([&](std::size_t i) { return job.in_planes[first + i] + offset; }, job.in_stride, count,
                      live, 0, f + first);
    }
    const bool is_interleaved = job.shape == Shape::interleaved;
    const std::size_t step = is_interleaved ? job.channels : 1;
    const T* const values = job.in + k * job.in_stride + channel * (is_interleaved ? 1 : count);
    gather([&](std::size_t i) { return values + i * step; }, job.in_stride, count, live, 0, f + first);
}
template <class T>
HWY_NOINLINE void scatter_channel(const Job<T>& job, std::size_t coefficients, std::size_t k,
                                  std::size_t channel, std::size_t live, const Pack<T>* f) {
    const std::size_t first = job.is_dc_apart ? 1 : 0;
    const std::size_t count = coefficients - first;
    if (job.shape == Shape::planes) {
        const std::size_t offset = job.out_begin + k * job.out_stride + channel;
        return scatter(
            f + first, [&](std::size_t i) { return job.out_planes[first + i] + offset; }, job.out_stride,
            count, live);
    }
    const bool is_interleaved = job.shape == Shape::interleaved;
    const std::size_t step = is_interleaved ? job.channels : 1;
    T* const values = job.out + k * job.out_stride + channel * (is_interleaved ? 1 : count);
    scatter(
        f + first, [&](std::size_t i) { return values + i * step; }, job.out_stride, count, live);
}

/// Turns all channels of the vectors from k on.
template <class Turn, class T>
HWY_NOINLINE void turn_copies(const Job<T>& job, Turn& turn, std::size_t k) {
    constexpr std::size_t kCoefficients = static_cast<std::size_t>(Turn::kOrder) * Turn::kOrder;
    Pack<T> f[kCoefficients];
    for (; k < job.count; k += kLanes<T>) {
        const std::size_t live = job.count - k < kLanes<T> ? job.count - k : kLanes<T>;
        if constexpr (Turn::kUse != Use::all_vectors) {
            Pack<T> R[9];
            gather_rotations(job, k, live, R);
            take_called(turn, R, job.form);
        }
        for (std::size_t channel = 0; channel < job.channels; ++channel) {
            gather_channel(job, kCoefficients, k, channel, live, f);
            turn_shared(job, turn, f);
            scatter_channel(job, kCoefficients, k, channel, live, f);
        }
    }
}

}  // namespace
}  // namespace zonal::batch
