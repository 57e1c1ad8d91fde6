#pragma once

#include <string>
#include <vector>

namespace zonal::gpu {

/// A signal value of three channels, as modules whose names end in _rgb take it.
struct Channels {
    using value_type = float;
    float r, g, b;
};

/// A generated C++ kernel without fused instructions and without contraction: the operations of a precise
/// module one by one. Arrays: `rotation` is R or what `prepare` made of it, null where the kernel takes none;
/// `input` is null where it takes no signal.
struct ReferenceKernel {
    std::string name = {};  ///< as names of files end: rotate, stable_rotate_zhf
    int rotation_size = 0;
    int input_size = 0;  ///< signal values
    int output_size = 0;
    void (*run)(const float* rotation, const float* input, float* output) = nullptr;
    /// Of `rotate` alone, which does something else for several channels: all others do for each channel what
    /// they do for one.
    void (*run_channels)(const float* rotation, const Channels* input, Channels* output) = nullptr;

    bool has_signal() const { return input_size > 0; }
    bool turns_signal() const { return has_signal() && rotation_size > 0; }
    /// Turns a signal, alone or with the step after it: there is a bound of its error.
    bool makes_turns() const { return turns_signal() || name == "prepare" || name == "blocks"; }
};

/// Every kernel of an order; throws std::out_of_range for an order that is not compiled in.
const std::vector<ReferenceKernel>& reference_kernels(int order);
const ReferenceKernel& reference_kernel(int order, const std::string& name);
/// The orders that are compiled in, ascending.
std::vector<int> reference_orders();

/// For the files that hold one order each.
bool add_reference_kernels(int order, std::vector<ReferenceKernel> kernels);

}  // namespace zonal::gpu
