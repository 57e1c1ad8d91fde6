#pragma once

#include <atomic>

namespace zonal::search {

/// For searches that nobody interrupts.
inline const std::atomic<bool> kNoStop = false;

}  // namespace zonal::search
