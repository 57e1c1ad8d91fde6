#include "gpu/compute.hpp"

#include <algorithm>

namespace zonal::gpu {

namespace {

std::vector<vk::DescriptorSetLayoutBinding> layout_bindings(const PipelineOptions& options) {
    std::vector<vk::DescriptorSetLayoutBinding> bindings;
    for (const std::uint32_t number : options.storage_buffers)
        bindings.emplace_back(number, vk::DescriptorType::eStorageBuffer, 1,
                              vk::ShaderStageFlagBits::eCompute);
    for (const std::uint32_t number : options.sampled_images)
        bindings.emplace_back(number, vk::DescriptorType::eCombinedImageSampler, 1,
                              vk::ShaderStageFlagBits::eCompute);
    return bindings;
}

const vk::PushConstantRange kCountRange(vk::ShaderStageFlagBits::eCompute, 0, sizeof(std::uint32_t));

vk::raii::Pipeline make_pipeline(const vk::raii::Device& device, const vk::raii::ShaderModule& module,
                                 const vk::raii::PipelineLayout& layout, const PipelineOptions& options) {
    const vk::SpecializationMapEntry entry(0, 0, sizeof options.workgroup_size);
    const vk::SpecializationInfo specialization(1, &entry, sizeof options.workgroup_size,
                                                &options.workgroup_size);
    const vk::PipelineShaderStageCreateInfo stage({}, vk::ShaderStageFlagBits::eCompute, *module, "main",
                                                  &specialization);
    return {device, nullptr, vk::ComputePipelineCreateInfo(options.flags, stage, *layout)};
}

/// A set and the pool it is from.
struct DescriptorSet {
    vk::raii::DescriptorPool pool;
    vk::raii::DescriptorSet set;
};

DescriptorSet bind(const vk::raii::Device& device, const vk::raii::DescriptorSetLayout& layout,
                   std::span<const Binding> bindings) {
    const auto count = std::max(1u, static_cast<std::uint32_t>(bindings.size()));
    const std::vector<vk::DescriptorPoolSize> sizes{{vk::DescriptorType::eStorageBuffer, count},
                                                    {vk::DescriptorType::eCombinedImageSampler, count}};
    vk::raii::DescriptorPool pool(device, {vk::DescriptorPoolCreateFlagBits::eFreeDescriptorSet, 1, sizes});
    vk::raii::DescriptorSet set = std::move(device.allocateDescriptorSets({*pool, *layout}).front());
    for (const Binding& binding : bindings) {
        vk::WriteDescriptorSet write(*set, binding.number, 0, 1);
        vk::DescriptorBufferInfo buffer_info;
        vk::DescriptorImageInfo image_info;
        if (const auto* buffer = std::get_if<const Buffer*>(&binding.resource)) {
            buffer_info = vk::DescriptorBufferInfo((*buffer)->handle(), 0, VK_WHOLE_SIZE);
            write.descriptorType = vk::DescriptorType::eStorageBuffer;
            write.pBufferInfo = &buffer_info;
        } else {
            const auto& image = std::get<SampledImage>(binding.resource);
            image_info = vk::DescriptorImageInfo(image.sampler, image.view, image.layout);
            write.descriptorType = vk::DescriptorType::eCombinedImageSampler;
            write.pImageInfo = &image_info;
        }
        device.updateDescriptorSets(write, {});
    }
    return {std::move(pool), std::move(set)};
}

}  // namespace

Buffer::Buffer(const Device& device, std::size_t size)
    : size_(size),
      buffer_(device.handle(),
              vk::BufferCreateInfo({}, size * sizeof(float), vk::BufferUsageFlagBits::eStorageBuffer)),
      memory_(nullptr) {
    const vk::MemoryRequirements needs = buffer_.getMemoryRequirements();
    memory_ = {device.handle(),
               vk::MemoryAllocateInfo(needs.size, device.host_memory_type(needs.memoryTypeBits))};
    buffer_.bindMemory(*memory_, 0);
    mapped_ = memory_.mapMemory(0, VK_WHOLE_SIZE);
    std::ranges::fill(values(), 0.0f);
}

Buffer::Buffer(const Device& device, std::span<const float> values) : Buffer(device, values.size()) {
    std::ranges::copy(values, this->values().begin());
}

ComputePipeline::ComputePipeline(const Device& device, std::span<const std::uint32_t> words,
                                 const PipelineOptions& options)
    : device_(device),
      workgroup_size_(options.workgroup_size),
      module_(device.handle(), vk::ShaderModuleCreateInfo({}, words.size_bytes(), words.data())),
      set_layout_(nullptr),
      layout_(nullptr),
      pipeline_(nullptr) {
    const auto bindings = layout_bindings(options);
    set_layout_ = {device.handle(), vk::DescriptorSetLayoutCreateInfo({}, bindings)};
    layout_ = {device.handle(), vk::PipelineLayoutCreateInfo({}, *set_layout_, kCountRange)};
    device.check_validation();
    pipeline_ = make_pipeline(device.handle(), module_, layout_, options);
    device.check_validation();
}

void ComputePipeline::dispatch(std::span<const Binding> bindings, std::uint32_t count) const {
    const DescriptorSet descriptors = bind(device_.handle(), set_layout_, bindings);
    device_.run([&](const vk::raii::CommandBuffer& commands) {
        commands.bindPipeline(vk::PipelineBindPoint::eCompute, *pipeline_);
        commands.bindDescriptorSets(vk::PipelineBindPoint::eCompute, *layout_, 0, *descriptors.set, {});
        commands.pushConstants<std::uint32_t>(*layout_, vk::ShaderStageFlagBits::eCompute, 0, count);
        commands.dispatch((count + workgroup_size_ - 1) / workgroup_size_, 1, 1);
        const vk::MemoryBarrier written(vk::AccessFlagBits::eShaderWrite, vk::AccessFlagBits::eHostRead);
        commands.pipelineBarrier(vk::PipelineStageFlagBits::eComputeShader, vk::PipelineStageFlagBits::eHost,
                                 {}, written, {}, {});
    });
}

void ComputePipeline::dispatch(std::initializer_list<const Buffer*> buffers, std::uint32_t count) const {
    std::vector<Binding> bindings;
    for (const Buffer* buffer : buffers)
        bindings.push_back({static_cast<std::uint32_t>(bindings.size()), buffer});
    dispatch(bindings, count);
}

}  // namespace zonal::gpu
