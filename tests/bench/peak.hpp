#pragma once

#include <cstddef>
#include <string_view>

namespace zonal::bench {

/// What a core can do at most, on packs of one instruction set and type.
struct Peak {
    std::size_t lanes;
    bool is_fused;                      ///< else a multiply-add is two instructions
    double (*run)(std::size_t rounds);  ///< kPeakChains multiply-adds a round; returns what keeps them alive
};

/// Independent chains of multiply-adds: more than latency times units of the processors we know, and few
/// enough for 16 registers.
inline constexpr std::size_t kPeakChains = 12;

/// `target` is one of batch::runnable_targets().
template <class T>
Peak peak_of(std::string_view target);

}  // namespace zonal::bench
