// Batches on packs, for one instruction set and one type: CMake compiles this file once for each, with
// ZONAL_BATCH_SCALAR (float or double) and ZONAL_BATCH_ENTRY (the name of the table defined at the end).
// Chooses for each job what turns (turns.hpp) and how memory is walked: rows by transposing (rows.hpp),
// planes and many channels as they are (planes.hpp), what is left over by copies (copies.hpp), three channels
// by one rotation as dense products (dense_channels.hpp). Only Highway, the generated headers and plain
// headers of this folder may be included here: any inline function of the standard library could be the copy
// that the linker keeps for every processor.

#define HWY_COMPILE_ONLY_STATIC
#include <type_traits>

#include "dense_channels.hpp"
#include "job.hpp"
#include "order_kernels.hpp"
#include "rows.hpp"

namespace zonal::batch {
namespace {

using T = ZONAL_BATCH_SCALAR;

/// Vectors in rows: whole packs transposed; the rest by channels where these fill packs, else by copies.
template <int N, int kFirst, class Turn>
void turn_rows(const Job<T>& job, Turn& turn) {
    using Walk = Rows<T, N, kFirst, Turn>;
    const std::size_t done =
        job.count >= kLanes<T> && Walk::is_in_blocks(job) ? Walk(job).turn_packs(turn) : 0;
    if constexpr (Turn::kUse != Use::one_channel)
        if (job.shape == Shape::interleaved && can_fill_packs(job)) return turn_across(job, turn, done);
    turn_copies(job, turn, done);
}

template <class Turn>
void turn_rows(const Job<T>& job, Turn& turn) {
    constexpr int N = Turn::kOrder;
    job.is_dc_apart ? turn_rows<N, 1>(job, turn) : turn_rows<N, 0>(job, turn);
}

bool is_across(const Job<T>& job) { return job.shape == Shape::interleaved && fill_packs(job); }

/// From so many channels on, dense products of four at a time meet too few values of a cache line.
constexpr std::size_t kLeastAcross = 64;

template <int N>
void each(const Job<T>& job) {
    if (job.channels == 1) {
        OneEach<T, N> turn;
        if (job.coefficient_form != nullptr) return turn_copies(job, turn, 0);
        return job.shape == Shape::planes ? turn_planar(job, turn) : turn_rows(job, turn);
    }
    Prepared<T, N, Use::channels> turn;
    if (job.shape == Shape::planes) return turn_copies(job, turn, 0);
    is_across(job) ? turn_across(job, turn, 0) : turn_rows(job, turn);
}

template <int N>
constexpr bool has_dense = kHasBlocksOfFour<T>&& turns_channels_densely(N);

template <int N>
void all(const Job<T>& job) {
    if constexpr (has_dense<N>)
        if (job.shape == Shape::interleaved && job.channels < kLeastAcross && job.coefficient_form == nullptr)
            return job.is_dc_apart ? turn_densely<T, N, 1>(job) : turn_densely<T, N, 0>(job);
    Prepared<T, N, Use::all_vectors> turn;
    turn.take(job.form, [&](Pack<T>* R) { gather_rotations(job, 0, 1, R); });
    if (job.shape == Shape::planes) return turn_planar(job, turn);
    is_across(job) ? turn_across(job, turn, 0) : turn_rows(job, turn);
}

constexpr std::size_t kFewEach = kLanes<T> * 5 / 8, kFewAll = kLanes<T> * 7 / 16;

#define ZONAL_BATCH_KERNEL(N) {N, each<N>, all<N>, kFewEach, kFewAll, has_dense<N> ? 2 : kFewAll},
constexpr Kernel<T> kKernels[] = {ZONAL_FOR_EACH_ORDER(ZONAL_BATCH_KERNEL)};
#undef ZONAL_BATCH_KERNEL

}  // namespace

KernelTable<T> ZONAL_BATCH_ENTRY();
KernelTable<T> ZONAL_BATCH_ENTRY() {
    return {kKernels, static_cast<int>(sizeof kKernels / sizeof kKernels[0])};
}

}  // namespace zonal::batch
