#pragma once

#include <string>

#include "gpu/module_runner.hpp"

namespace zonal::gpu {

/// What a kernel of an order is run with: random and hard rotations, random and hard signals (design of the
/// tests' hard cases: energy in one band, 1e30, 1e-30, zeros), and at the end signals with a NaN in one band.
/// A number of vectors that is no multiple of a workgroup. `channels`: floats of a signal value, 1 or 3.
Vectors test_vectors(int order, const ReferenceKernel& kernel, int channels);

/// What C++ makes of them, in the modules' layout.
std::vector<float> expected_results(const ReferenceKernel& kernel, const Vectors& vectors, int channels);

/// How the banner calls the bound that holds for a kernel that turns, in a form of so many channels.
std::string bound_name(int order, const ReferenceKernel& kernel, int channels);

/// Where two arrays of results differ, a NaN being equal to any NaN: an empty text where they do not.
/// `size`: floats of one vector.
std::string difference(const std::vector<float>& got, const std::vector<float>& wanted, int size);

/// The same where a compiler may have arranged sums anew: empty where every vector is as near as two results
/// may be that are both within the kernel's bound. For kernels that turn, twice the published bound and
/// excess of the signal's norm (`prepare` and `blocks`: after the step that they are made for); for those
/// that are linear in a signal or in R, twice gamma(3 n - 1) |M| |f| for an output of n terms. Needs `got` of
/// C++'s `vectors`.
std::string distance(int order, const ReferenceKernel& kernel, const Vectors& vectors,
                     const std::vector<float>& got, const std::vector<float>& wanted, int channels);

}  // namespace zonal::gpu
