#include "gpu/vulkan_device.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>

#include "gpu/environment_variable.hpp"

namespace zonal::gpu {

namespace {

namespace fs = std::filesystem;

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kNoDevice =
    "no Vulkan device: found no driver that offers one, wanted at least one device; install the package "
    "mesa-vulkan-drivers (lavapipe needs no GPU), or set VK_ICD_FILENAMES to a driver that works";

/// The loader's description of a Mesa driver, by how its file's name begins.
std::string driver_file(const std::string& stem) {
    const std::vector<std::string> folders{"/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d",
                                           "/usr/share/vulkan/icd.d"};
    for (const std::string& folder : folders) {
        if (!fs::is_directory(folder)) continue;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with(stem) && name.ends_with(".json")) return entry.path().string();
        }
    }
    throw std::runtime_error(
        fmt::format("no Vulkan device: found no {}*.json in {}, wanted Mesa's driver; install the package "
                    "mesa-vulkan-drivers, or set VK_ICD_FILENAMES",
                    stem, fmt::join(folders, ", ")));
}

/// The environment that an instance and its device are made in.
std::vector<std::unique_ptr<EnvironmentVariable>> environment_of(const DeviceOptions& options) {
    std::vector<std::unique_ptr<EnvironmentVariable>> variables;
    const auto set = [&](const char* name, const std::string& value) {
        variables.push_back(std::make_unique<EnvironmentVariable>(name, value));
    };
    const auto set_driver = [&](const std::string& file) {
        set("VK_ICD_FILENAMES", file);  // what loaders before 1.3.207 read
        set("VK_DRIVER_FILES", file);
    };
    if (options.radv_family) {
        set_driver(driver_file("radeon_icd"));
        set("RADV_FORCE_FAMILY", *options.radv_family);
    } else if (std::getenv("VK_ICD_FILENAMES") == nullptr && std::getenv("VK_DRIVER_FILES") == nullptr) {
        set_driver(driver_file("lvp_icd"));
    }
    // What a device says of its code must not depend on what it once compiled.
    set("MESA_SHADER_CACHE_DISABLE", "true");
    return variables;
}

VKAPI_ATTR VkBool32 VKAPI_CALL receive(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                       VkDebugUtilsMessageTypeFlagsEXT,
                                       const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
    static_cast<ValidationMessages*>(messages)->add(data->pMessage);
    return VK_FALSE;
}

vk::raii::Instance make_instance(const vk::raii::Context& context) {
    const auto layers = context.enumerateInstanceLayerProperties();
    if (std::ranges::none_of(layers, [](const vk::LayerProperties& layer) {
            return std::string(layer.layerName.data()) == kValidationLayer;
        }))
        throw std::runtime_error(fmt::format(
            "found no Vulkan layer {}; install the package vulkan-validationlayers", kValidationLayer));
    const vk::ApplicationInfo application("zonal", 1, "zonal", 1, VK_API_VERSION_1_1);
    const std::vector<const char*> layer_names{kValidationLayer},
        extensions{VK_EXT_DEBUG_UTILS_EXTENSION_NAME};
    try {
        return {context, vk::InstanceCreateInfo({}, &application, layer_names, extensions)};
    } catch (const vk::IncompatibleDriverError&) {
        throw std::runtime_error(kNoDevice);
    }
}

vk::DebugUtilsMessengerCreateInfoEXT messenger_info(ValidationMessages& messages) {
    using Severity = vk::DebugUtilsMessageSeverityFlagBitsEXT;
    using Type = vk::DebugUtilsMessageTypeFlagBitsEXT;
    return {
        {}, Severity::eError, Type::eGeneral | Type::eValidation | Type::ePerformance, receive, &messages};
}

vk::raii::PhysicalDevice first_device(const vk::raii::Instance& instance) {
    const auto devices = (*instance).enumeratePhysicalDevices(*instance.getDispatcher());
    if (devices.empty()) throw std::runtime_error(kNoDevice);
    return {instance, devices.front()};
}

std::uint32_t compute_queue_family(const vk::raii::PhysicalDevice& device) {
    const auto families = device.getQueueFamilyProperties();
    for (std::uint32_t k = 0; k < families.size(); ++k)
        if (families[k].queueFlags & vk::QueueFlagBits::eCompute) return k;
    throw std::runtime_error(fmt::format("{}: the device has no queue for compute; choose another driver",
                                         device.getProperties().deviceName.data()));
}

vk::raii::Device make_device(const vk::raii::PhysicalDevice& physical, std::uint32_t family,
                             const DeviceOptions& options) {
    const float priority = 1;
    const vk::DeviceQueueCreateInfo queue({}, family, 1, &priority);
    std::vector<const char*> extensions;
    vk::PhysicalDeviceFeatures features;
    // Lobes of every band sample cube maps of their own: an array of them.
    features.imageCubeArray = physical.getFeatures().imageCubeArray;
    vk::DeviceCreateInfo info({}, queue, {}, extensions, &features);
    vk::PhysicalDevicePipelineExecutablePropertiesFeaturesKHR executable_properties(VK_TRUE);
    if (options.wants_executable_properties) {
        extensions.push_back(VK_KHR_PIPELINE_EXECUTABLE_PROPERTIES_EXTENSION_NAME);
        info.setPEnabledExtensionNames(extensions);
        info.pNext = &executable_properties;
    }
    return {physical, info};
}

}  // namespace

void ValidationMessages::add(const std::string& text) {
    const std::lock_guard lock(mutex_);
    fmt::print(stderr, "{}\n", text);
    errors_.push_back(text);
}

void ValidationMessages::check() {
    const std::lock_guard lock(mutex_);
    if (errors_.empty()) return;
    const std::string text = fmt::format("Vulkan validation: {}", fmt::join(errors_, "\n"));
    errors_.clear();
    throw std::runtime_error(text);
}

Device::Device(const DeviceOptions& options)
    : messages_(std::make_shared<ValidationMessages>()),
      instance_(nullptr),
      messenger_(nullptr),
      physical_(nullptr),
      device_(nullptr),
      queue_(nullptr),
      commands_(nullptr) {
    const auto environment = environment_of(options);
    instance_ = make_instance(context_);
    messenger_ = {instance_, messenger_info(*messages_)};
    physical_ = first_device(instance_);
    queue_family_ = compute_queue_family(physical_);
    device_ = make_device(physical_, queue_family_, options);
    queue_ = device_.getQueue(queue_family_, 0);
    commands_ = {device_, vk::CommandPoolCreateInfo({}, queue_family_)};
    check_validation();
}

std::string Device::name() const {
    const auto chain =
        physical_.getProperties2<vk::PhysicalDeviceProperties2, vk::PhysicalDeviceDriverProperties>();
    const auto& driver = chain.get<vk::PhysicalDeviceDriverProperties>();
    return fmt::format("{}, {} {}", physical_.getProperties().deviceName.data(), driver.driverName.data(),
                       driver.driverInfo.data());
}

std::uint32_t Device::host_memory_type(std::uint32_t bits) const {
    const auto wanted = vk::MemoryPropertyFlagBits::eHostVisible | vk::MemoryPropertyFlagBits::eHostCoherent;
    const auto memory = physical_.getMemoryProperties();
    for (std::uint32_t k = 0; k < memory.memoryTypeCount; ++k)
        if ((bits >> k & 1) != 0 && (memory.memoryTypes[k].propertyFlags & wanted) == wanted) return k;
    throw std::runtime_error(name() + ": no memory that the host sees; choose another driver");
}

vk::raii::CommandBuffer Device::begin() const {
    const vk::CommandBufferAllocateInfo info(*commands_, vk::CommandBufferLevel::ePrimary, 1);
    vk::raii::CommandBuffer buffer = std::move(device_.allocateCommandBuffers(info).front());
    buffer.begin(vk::CommandBufferBeginInfo(vk::CommandBufferUsageFlagBits::eOneTimeSubmit));
    return buffer;
}

void Device::submit(const vk::raii::CommandBuffer& buffer) const {
    buffer.end();
    queue_.submit(vk::SubmitInfo({}, {}, *buffer));
    queue_.waitIdle();
    check_validation();
}

}  // namespace zonal::gpu
