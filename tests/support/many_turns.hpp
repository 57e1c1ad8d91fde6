#pragma once

#include <cstdint>
#include <map>

#include "support/accuracy.hpp"

namespace zonal::accuracy {

/// The largest error of a band over random turns of random signals in float, relative to what the signal has
/// in that band, less the kernel's excess. Bands turn apart, so this is the error of signals of one band, and
/// those of whole signals are smaller.
std::map<std::string, double> worst_of_many_turns(int order, const std::vector<Contestant<float>>& kernels,
                                                  const Contestant<double>& judge, std::int64_t turns,
                                                  std::uint64_t seed);

}  // namespace zonal::accuracy
