#pragma once

#include "job.hpp"

namespace zonal::batch {

/// Turns the vectors of a job one by one, by the kernels of single calls.
template <class T>
void turn_few(int order, const Job<T>& job, bool is_one_for_all);

}  // namespace zonal::batch
