#pragma once

#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>
#include <vulkan/vulkan_raii.hpp>

namespace zonal::gpu {

/// Which driver makes the device, and what it must be able to do.
struct DeviceOptions {
    /// Mesa's lavapipe, which runs on the processor; or, with a family such as "navi21" or "vega10", the null
    /// device of Mesa's RADV, which compiles for that family of GPU and can neither allocate nor dispatch.
    /// lavapipe gives way to VK_ICD_FILENAMES or VK_DRIVER_FILES of whoever runs the program, RADV does not.
    std::optional<std::string> radv_family;
    /// VK_KHR_pipeline_executable_properties: what a driver tells of the code it made of a pipeline.
    bool wants_executable_properties = false;
};

/// What the validation layers said. Shared by a device and the callback that its driver calls.
class ValidationMessages {
  public:
    void add(const std::string& text);
    /// Throws std::runtime_error with every error since the last call, if there was one.
    void check();

  private:
    std::mutex mutex_;
    std::vector<std::string> errors_;
};

/// An instance with VK_LAYER_KHRONOS_validation, the first device of its driver and one queue for compute.
/// Vulkan 1.1. Errors throw std::runtime_error (vk::SystemError is one) and name what to install where no
/// driver, layer or device is found.
class Device {
  public:
    explicit Device(const DeviceOptions& options = {});

    const vk::raii::Device& handle() const { return device_; }
    const vk::raii::PhysicalDevice& physical() const { return physical_; }
    const vk::raii::Queue& queue() const { return queue_; }
    const vk::raii::CommandPool& commands() const { return commands_; }
    /// The device's and the driver's name and version.
    std::string name() const;
    /// The type of host-visible, coherent memory among those that `bits` allows.
    std::uint32_t host_memory_type(std::uint32_t bits) const;
    /// Runs what `record` puts into a command buffer and waits for it; then looks at the validation messages.
    template <class Record>
    void run(const Record& record) const {
        const vk::raii::CommandBuffer buffer = begin();
        record(buffer);
        submit(buffer);
    }
    /// Throws if the validation layers found errors since the last call.
    void check_validation() const { messages_->check(); }
    /// They outlive the device: what is said while it is destroyed is there to be checked afterwards.
    const std::shared_ptr<ValidationMessages>& validation_messages() const { return messages_; }

  private:
    vk::raii::CommandBuffer begin() const;
    void submit(const vk::raii::CommandBuffer& buffer) const;

    std::shared_ptr<ValidationMessages> messages_;
    vk::raii::Context context_;
    vk::raii::Instance instance_;
    vk::raii::DebugUtilsMessengerEXT messenger_;
    vk::raii::PhysicalDevice physical_;
    std::uint32_t queue_family_ = 0;
    vk::raii::Device device_;
    vk::raii::Queue queue_;
    vk::raii::CommandPool commands_;
};

}  // namespace zonal::gpu
