#pragma once

#include <memory>
#include <vector>

#include "gpu/reference.hpp"
#include "gpu/shader_modules.hpp"

namespace zonal::gpu {

/// Vectors that one dispatch turns, tightly packed: [vector][element][channel].
struct Vectors {
    int count = 0;
    std::vector<float> rotations;  ///< empty where the kernel takes none
    std::vector<float> inputs;     ///< empty where the kernel takes no signal
    std::vector<float> matrices;   ///< R of each vector, whatever the kernel takes
};

/// A compute module of this project on the process's Vulkan device.
class ModuleRunner {
  public:
    /// `output_size`: floats of one vector's result.
    ModuleRunner(const Words& words, int output_size, int workgroup_size = 64);
    ~ModuleRunner();
    /// The results. Throws std::runtime_error if the module wrote beyond the last vector's.
    std::vector<float> run(const Vectors& vectors) const;
    /// The same with one buffer for input and output, which are of one size.
    std::vector<float> run_in_place(const Vectors& vectors) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

/// The device's name, made on first use; throws std::runtime_error where there is none.
std::string device_name();
/// Destroys the device; throws if the validation layers find that something of it was left.
void close_device();

}  // namespace zonal::gpu
