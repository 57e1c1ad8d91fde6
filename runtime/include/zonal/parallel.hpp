#pragma once

// Batches on several cores by oneTBB. Header-only, and the only header that needs it: link zonal::parallel.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include "zonal/batch.hpp"

namespace zonal {

/// An executor that runs ranges of a batch on the threads of oneTBB's current arena; tbb::task_arena and
/// tbb::global_control choose how many they are.
/// grain : vectors in the smallest range. Results do not depend on it, nor on the number of threads: each
///         vector is rotated alike wherever it stands.
inline Executor on_all_cores(std::size_t grain = 1024) {
    return [grain](std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
        tbb::parallel_for(
            tbb::blocked_range<std::size_t>(0, count, grain),
            [&](const tbb::blocked_range<std::size_t>& range) { body(range.begin(), range.end()); });
    };
}

}  // namespace zonal
