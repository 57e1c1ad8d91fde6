#pragma once

#include <map>
#include <string>
#include <vector>

#include "graph/kernel.hpp"

namespace zonal::kernels {

/// The largest relative errors that a kernel's bound allows, by the type of its numbers.
struct ErrorBounds {
    double in_float = 0;
    double in_double = 0;
};

enum class Processor {
    cpu,  ///< one call takes the time that `graph::call_cycles` says
    gpu   ///< thousands of calls hide all waiting: time is instructions
};

/// The kernels that `rotate` is, by name: for one vector, and for a signal value of three channels.
struct RotateChoice {
    std::string one, channels;
};

/// The fastest kernels whose bounds are at most five times those of `rotate_accurate` and twice what the
/// contract asks of `rotate`; of those within a tenth of that time, the most accurate. `bounds`: by kernel,
/// of the arithmetic of that processor. Throws std::logic_error where one is missing.
RotateChoice choose_rotate(int order, const std::vector<graph::Kernel>& kernels,
                           const std::map<std::string, ErrorBounds>& bounds, Processor processor);

/// The time of one call with a rotation and a value of so many channels, in cycles or instructions.
double call_time(const graph::Kernel& kernel, int channels, Processor processor);

/// `rotate`, which has the body of what was chosen.
graph::Kernel make_rotate(const std::vector<graph::Kernel>& kernels, const RotateChoice& choice);

}  // namespace zonal::kernels
