#include "gpu/tailored/cube_map_array.hpp"

#include <fmt/format.h>

#include <cstring>
#include <stdexcept>
#include <vector>

namespace zonal::gpu {

namespace {

constexpr std::uint32_t kFaces = 6;

void check_filter(const Device& device, vk::Format format) {
    const auto wanted =
        vk::FormatFeatureFlagBits::eSampledImageFilterLinear | vk::FormatFeatureFlagBits::eTransferDst;
    if ((device.physical().getFormatProperties(format).optimalTilingFeatures & wanted) != wanted)
        throw std::runtime_error(fmt::format("{}: the device cannot filter {}; choose another format",
                                             device.name(), vk::to_string(format)));
}

vk::ImageCreateInfo image_info(const CubeMapLayout& layout) {
    return {vk::ImageCreateFlagBits::eCubeCompatible,
            vk::ImageType::e2D,
            layout.format,
            {layout.face_size, layout.face_size, 1},
            layout.level_count,
            kFaces * layout.cube_count,
            vk::SampleCountFlagBits::e1,
            vk::ImageTiling::eOptimal,
            vk::ImageUsageFlagBits::eSampled | vk::ImageUsageFlagBits::eTransferDst};
}

vk::ImageSubresourceRange all_of(const CubeMapLayout& layout) {
    return {vk::ImageAspectFlagBits::eColor, 0, layout.level_count, 0, kFaces * layout.cube_count};
}

std::vector<vk::BufferImageCopy> level_copies(const CubeMapLayout& layout) {
    std::vector<vk::BufferImageCopy> copies;
    vk::DeviceSize offset = 0;
    for (std::uint32_t level = 0; level < layout.level_count; ++level) {
        const std::uint32_t size = layout.face_size >> level, layers = kFaces * layout.cube_count;
        copies.push_back(
            {offset, 0, 0, {vk::ImageAspectFlagBits::eColor, level, 0, layers}, {}, {size, size, 1}});
        offset += vk::DeviceSize{size} * size * layers * layout.texel_bytes;
    }
    return copies;
}

void upload(const Device& device, vk::Image image, const CubeMapLayout& layout,
            std::span<const std::byte> texels) {
    const vk::raii::Buffer staging(
        device.handle(),
        vk::BufferCreateInfo({}, texels.size_bytes(), vk::BufferUsageFlagBits::eTransferSrc));
    const vk::MemoryRequirements needs = staging.getMemoryRequirements();
    const vk::raii::DeviceMemory memory(
        device.handle(), vk::MemoryAllocateInfo(needs.size, device.host_memory_type(needs.memoryTypeBits)));
    staging.bindMemory(*memory, 0);
    std::memcpy(memory.mapMemory(0, VK_WHOLE_SIZE), texels.data(), texels.size_bytes());
    using Layout = vk::ImageLayout;
    using Stage = vk::PipelineStageFlagBits;
    const auto barrier = [&](vk::AccessFlags before, vk::AccessFlags after, Layout from, Layout to) {
        return vk::ImageMemoryBarrier(before, after, from, to, VK_QUEUE_FAMILY_IGNORED,
                                      VK_QUEUE_FAMILY_IGNORED, image, all_of(layout));
    };
    device.run([&](const vk::raii::CommandBuffer& commands) {
        commands.pipelineBarrier(
            Stage::eTopOfPipe, Stage::eTransfer, {}, {}, {},
            barrier({}, vk::AccessFlagBits::eTransferWrite, Layout::eUndefined, Layout::eTransferDstOptimal));
        commands.copyBufferToImage(*staging, image, Layout::eTransferDstOptimal, level_copies(layout));
        commands.pipelineBarrier(Stage::eTransfer, Stage::eComputeShader, {}, {}, {},
                                 barrier(vk::AccessFlagBits::eTransferWrite, vk::AccessFlagBits::eShaderRead,
                                         Layout::eTransferDstOptimal, Layout::eShaderReadOnlyOptimal));
    });
}

vk::SamplerCreateInfo trilinear() {
    vk::SamplerCreateInfo info({}, vk::Filter::eLinear, vk::Filter::eLinear, vk::SamplerMipmapMode::eLinear);
    info.addressModeU = info.addressModeV = info.addressModeW = vk::SamplerAddressMode::eClampToEdge;
    info.maxLod = VK_LOD_CLAMP_NONE;
    return info;
}

}  // namespace

CubeMapArray::CubeMapArray(const Device& device, const CubeMapLayout& layout,
                           std::span<const std::byte> texels)
    : image_(device.handle(), image_info(layout)),
      memory_(nullptr),
      view_(nullptr),
      sampler_(device.handle(), trilinear()) {
    check_filter(device, layout.format);
    const vk::MemoryRequirements needs = image_.getMemoryRequirements();
    memory_ = {device.handle(),
               vk::MemoryAllocateInfo(needs.size, device.host_memory_type(needs.memoryTypeBits))};
    image_.bindMemory(*memory_, 0);
    view_ = {device.handle(), vk::ImageViewCreateInfo({}, *image_, vk::ImageViewType::eCubeArray,
                                                      layout.format, {}, all_of(layout))};
    upload(device, *image_, layout, texels);
}

}  // namespace zonal::gpu
