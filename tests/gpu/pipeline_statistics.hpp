#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "gpu/vulkan_device.hpp"

namespace zonal::gpu {

/// What Mesa's RADV says of the code that it made of one compute module. Registers are those of a lane
/// (vector) or of a whole wave (scalar); cycles are the compiler's estimate for one wave, caches aside.
struct PipelineStatistics {
    std::uint64_t instructions = 0;
    std::uint64_t vgprs = 0;
    std::uint64_t sgprs = 0;
    std::uint64_t spilled_vgprs = 0;
    std::uint64_t spilled_sgprs = 0;
    std::uint64_t code_bytes = 0;
    std::uint64_t waves_per_simd = 0;      ///< most that fit beside each other
    std::uint64_t latency_cycles = 0;      ///< from a wave's first instruction to its last
    std::uint64_t inverse_throughput = 0;  ///< cycles that a wave keeps the processor busy
};

/// Creates the module's pipeline, which is never run. Bindings of set 0: storage buffers at 0, 1, 2 and 4, a
/// combined image sampler at 3. The device must be one of RADV that `wants_executable_properties`; throws
/// std::runtime_error, naming the statistic, for another driver's, and where the validation layers find an
/// error in the module.
PipelineStatistics statistics_of(const Device& device, std::span<const std::uint32_t> words);

}  // namespace zonal::gpu
