#pragma once

// Which instruction sets the batch kernels are compiled for, and which of them runs.

#include <cstddef>
#include <string_view>
#include <vector>

#include "job.hpp"
#include "zonal/api.hpp"

namespace zonal::batch {

/// Names of the instruction sets that are compiled in and that this processor has, the best first; the last
/// is what the library itself is compiled for.
ZONAL_API std::vector<std::string_view> runnable_targets();

/// Makes every later call use this one of `runnable_targets()`; an empty name: the best again. For tests and
/// benchmarks. Returns false, and changes nothing, when there is no such target.
ZONAL_API bool choose_target(std::string_view name);

/// Name of the target in use.
ZONAL_API std::string_view chosen_target();

/// Batches that move more bytes than this are written past the caches. An ordinary store reads its line
/// before it is overwritten, a third of the traffic; avoiding that pays only where the output would not have
/// stayed in the caches anyway.
inline constexpr std::size_t kStreamedBytes = std::size_t{32} << 20;

/// The limit in use; set for tests and benchmarks only.
ZONAL_API std::size_t streamed_bytes();
ZONAL_API void set_streamed_bytes(std::size_t bytes);

/// Kernels of the target in use.
template <class T>
KernelTable<T> kernels();

}  // namespace zonal::batch
