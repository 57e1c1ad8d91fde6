#include "gpu/module_runner.hpp"

#include <algorithm>
#include <stdexcept>

#include "gpu/compute.hpp"

namespace zonal::gpu {

namespace {

/// What a buffer holds behind its last vector, and in front of nothing.
constexpr float kUntouched = 12345.5f;
constexpr std::size_t kGuard = 256;

std::unique_ptr<Device>& the_device() {
    static std::unique_ptr<Device> device;
    return device;
}

const Device& device() {
    if (!the_device()) the_device() = std::make_unique<Device>();
    return *the_device();
}

/// Elements and a guard behind them.
Buffer guarded(const std::vector<float>& values, std::size_t size) {
    Buffer buffer(device(), size + kGuard);
    std::ranges::fill(buffer.values(), kUntouched);
    std::ranges::copy(values, buffer.values().begin());
    return buffer;
}

}  // namespace

struct ModuleRunner::Impl {
    ComputePipeline pipeline;
    int output_size;
};

ModuleRunner::ModuleRunner(const Words& words, int output_size, int workgroup_size)
    : impl_(new Impl{
          ComputePipeline(device(), words, {.workgroup_size = static_cast<std::uint32_t>(workgroup_size)}),
          output_size}) {}

ModuleRunner::~ModuleRunner() = default;

namespace {

std::vector<float> result_in(const Buffer& buffer, std::size_t size) {
    const auto values = buffer.values();
    if (std::ranges::any_of(values.subspan(size), [](float value) { return value != kUntouched; }))
        throw std::runtime_error("the module wrote behind the last vector");
    return {values.begin(), values.begin() + static_cast<std::ptrdiff_t>(size)};
}

}  // namespace

std::vector<float> ModuleRunner::run(const Vectors& vectors) const {
    const std::size_t size = static_cast<std::size_t>(vectors.count) * impl_->output_size;
    const Buffer rotations = guarded(vectors.rotations, vectors.rotations.size()),
                 inputs = guarded(vectors.inputs, vectors.inputs.size()), outputs = guarded({}, size);
    impl_->pipeline.dispatch({&rotations, &inputs, &outputs}, static_cast<std::uint32_t>(vectors.count));
    return result_in(outputs, size);
}

std::vector<float> ModuleRunner::run_in_place(const Vectors& vectors) const {
    const Buffer rotations = guarded(vectors.rotations, vectors.rotations.size()),
                 both = guarded(vectors.inputs, vectors.inputs.size());
    impl_->pipeline.dispatch({&rotations, &both, &both}, static_cast<std::uint32_t>(vectors.count));
    return result_in(both, vectors.inputs.size());
}

std::string device_name() { return device().name(); }

void close_device() {
    if (!the_device()) return;
    const std::shared_ptr<ValidationMessages> messages = the_device()->validation_messages();
    the_device().reset();
    messages->check();
}

}  // namespace zonal::gpu
