#include "gpu/pipeline_statistics.hpp"

#include <fmt/format.h>

#include <map>
#include <stdexcept>

#include "gpu/compute.hpp"

namespace zonal::gpu {

PipelineStatistics statistics_of(const Device& device, std::span<const std::uint32_t> words) {
    PipelineOptions options;
    options.storage_buffers = {0, 1, 2, 4};
    options.sampled_images = {3};
    options.flags = vk::PipelineCreateFlagBits::eCaptureStatisticsKHR;
    const ComputePipeline pipeline(device, words, options);
    std::map<std::string, std::uint64_t> found;
    for (const auto& statistic : device.handle().getPipelineExecutableStatisticsKHR({*pipeline.handle(), 0}))
        found[statistic.name.data()] = statistic.value.u64;
    const auto get = [&](const std::string& name) {
        const auto value = found.find(name);
        if (value == found.end())
            throw std::runtime_error(fmt::format(
                "{}: found no statistic '{}', wanted those of Mesa's RADV; install mesa-vulkan-drivers 22.3 "
                "or later and choose a radv family",
                device.name(), name));
        return value->second;
    };
    return {.instructions = get("Instructions"),
            .vgprs = get("VGPRs"),
            .sgprs = get("SGPRs"),
            .spilled_vgprs = get("Spilled VGPRs"),
            .spilled_sgprs = get("Spilled SGPRs"),
            .code_bytes = get("Code size"),
            .waves_per_simd = get("Subgroups per SIMD"),
            .latency_cycles = get("Latency"),
            .inverse_throughput = get("Inverse Throughput")};
}

}  // namespace zonal::gpu
