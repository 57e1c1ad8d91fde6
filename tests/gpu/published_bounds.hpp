#pragma once

#include <functional>
#include <string>
#include <vector>

#include "gpu/module_runner.hpp"
#include "support/accuracy.hpp"

namespace zonal::gpu {

/// Runs a kernel of an order on vectors, in the modules' layout, and returns the results.
using RunKernel = std::function<std::vector<float>(const ReferenceKernel& kernel, const Vectors& vectors)>;

/// The worst of a kernel's errors, beside what its banner publishes.
struct WorstOfKernel {
    std::string kernel = {};
    double error = 0;  ///< less the published excess times ‖R Rᵀ - I‖_F
    double bound = 0;
    std::string problem = {};  ///< where it was met
};

/// Judges kernels that make turns by the pointwise oracle; mirrors go as -R to those that take none.
/// `channels`: 1 or 3; of three channels one holds the signal that is judged, another one of every vector in
/// turn, and the others a different signal.
std::vector<WorstOfKernel> worst_of_kernels(int order, const std::vector<ReferenceKernel>& kernels,
                                            const std::vector<accuracy::Problem>& problems, int channels,
                                            const RunKernel& run);

/// Every kernel of an order that makes turns.
std::vector<ReferenceKernel> turning_kernels(int order);

/// Tilts of 1e-25 … 1e-9 rad from both poles, each with a random signal, and first the smallest that was once
/// wrong in float: R = {1, 0, 0, 0, 1, t, 0, -t, 1} with t = 1.08e-19, whose square is no normal float.
std::vector<accuracy::Problem> tiny_tilts(int order);

/// Expects every error within its bound; `form`: what is judged.
void expect_within(const std::vector<WorstOfKernel>& worst, const std::string& form, int order);

}  // namespace zonal::gpu
