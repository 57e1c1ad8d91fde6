#pragma once

#include <cstddef>
#include <span>

#include "gpu/compute.hpp"
#include "gpu/vulkan_device.hpp"

namespace zonal::gpu {

/// Sizes of an array of cube maps, and how its texels are stored.
struct CubeMapLayout {
    vk::Format format;
    std::uint32_t face_size = 0;  ///< along an edge, level 0
    std::uint32_t level_count = 0;
    std::uint32_t cube_count = 0;
    std::size_t texel_bytes = 0;
};

/// An array of cube maps with mip levels and a sampler that is linear within and between levels.
class CubeMapArray {
  public:
    /// `texels`: by level, cube, face (+x, -x, +y, -y, +z, -z), row, column. Throws std::runtime_error where
    /// the device cannot filter the format.
    CubeMapArray(const Device& device, const CubeMapLayout& layout, std::span<const std::byte> texels);

    SampledImage sampled() const { return {*view_, *sampler_}; }

  private:
    vk::raii::Image image_;
    vk::raii::DeviceMemory memory_;
    vk::raii::ImageView view_;
    vk::raii::Sampler sampler_;
};

}  // namespace zonal::gpu
