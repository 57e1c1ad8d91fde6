#pragma once

#include <cstring>
#include <span>
#include <variant>

#include "gpu/vulkan_device.hpp"

namespace zonal::gpu {

/// A storage buffer of floats that the host reads and writes directly.
class Buffer {
  public:
    /// `size` floats, at least one, all zero.
    Buffer(const Device& device, std::size_t size);
    Buffer(const Device& device, std::span<const float> values);

    std::span<float> values() const { return {static_cast<float*>(mapped_), size_}; }
    vk::Buffer handle() const { return *buffer_; }

  private:
    std::size_t size_;
    vk::raii::Buffer buffer_;
    vk::raii::DeviceMemory memory_;
    void* mapped_;
};

/// An image with its sampler, in the layout that shaders read it in.
struct SampledImage {
    vk::ImageView view;
    vk::Sampler sampler;
    vk::ImageLayout layout = vk::ImageLayout::eShaderReadOnlyOptimal;
};

/// What a shader finds at a binding of set 0.
struct Binding {
    std::uint32_t number = 0;
    std::variant<const Buffer*, SampledImage> resource;
};

struct PipelineOptions {
    std::vector<std::uint32_t> storage_buffers{0, 1, 2};  ///< their bindings
    std::vector<std::uint32_t> sampled_images = {};       ///< their bindings
    std::uint32_t workgroup_size = 64;                    ///< SpecId 0
    vk::PipelineCreateFlags flags = {};                   ///< for example eCaptureStatisticsKHR
};

/// A compute module's entry point `main`. One push constant: a uint at offset 0, how many invocations work.
class ComputePipeline {
  public:
    /// `device` must outlive it. Throws std::runtime_error where the validation layers find an error.
    ComputePipeline(const Device& device, std::span<const std::uint32_t> words,
                    const PipelineOptions& options = {});

    const vk::raii::Pipeline& handle() const { return pipeline_; }
    /// Runs `count` invocations, in as many workgroups as they need, and waits for them.
    void dispatch(std::span<const Binding> bindings, std::uint32_t count) const;
    /// The buffers at bindings 0, 1, 2 ….
    void dispatch(std::initializer_list<const Buffer*> buffers, std::uint32_t count) const;

  private:
    const Device& device_;
    std::uint32_t workgroup_size_;
    vk::raii::ShaderModule module_;
    vk::raii::DescriptorSetLayout set_layout_;
    vk::raii::PipelineLayout layout_;
    vk::raii::Pipeline pipeline_;
};

}  // namespace zonal::gpu
