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

/// Where two arrays of results differ, a NaN being equal to any NaN: an empty text where they do not.
/// `size`: floats of one vector.
std::string difference(const std::vector<float>& got, const std::vector<float>& wanted, int size);

/// The largest |got - wanted| of a vector in units of its largest value's last place (2^-24 of it).
double largest_relative_difference(const std::vector<float>& got, const std::vector<float>& wanted, int size);

}  // namespace zonal::gpu
