#pragma once

#include <functional>
#include <string>
#include <vector>

#include "support/hard_cases.hpp"
#include "support/oracle.hpp"

namespace zonal::accuracy {

/// A kernel that turns a signal, as it is judged: `rotate(R, f, out)`.
template <class T>
struct Contestant {
    std::string name;
    std::function<void(const T* R, const T* f, T* out)> rotate;
    double excess = 0;  ///< what its bound grows by for each unit of ‖R Rᵀ - I‖_F
};

/// The same kernel for mirrors too, where it is right for determinant +1 only: turned by -R, odd bands
/// negated.
template <class T>
Contestant<T> with_mirrors(int order, Contestant<T> kernel);

/// What is turned: random rotations, the hard rotations (of each kind 100, a third of that above order 10,
/// and every `thinning`-th beyond), a random signal each, and the hard signals.
struct Problem {
    std::string name;
    cases::Matrix rotation;
    std::vector<double> signal;
    bool is_noisy = false;         ///< the rotation is meant not to be orthonormal
    bool has_hard_signal = false;  ///< and a random rotation
};
template <class T>
std::vector<Problem> problems(int order, int random_count, int thinning, std::uint64_t seed);
/// Each of cases::tiny_tilts with so many random signals, one after another.
std::vector<Problem> tiny_tilts(int order, std::uint64_t seed, int signals = 1);

/// The worst error of a kernel: ‖result - exact‖₂ / ‖f‖₂ less what R itself excuses, where exact is the turn
/// by the orthonormal matrix nearest to R as it is given in T. NaN counts as infinite.
/// Throws std::invalid_argument where there is no problem or no kernel.
struct Worst {
    double error = 0;  ///< less the kernel's own excess times ‖R Rᵀ - I‖_F
    std::string name;  ///< where it was met
    /// Less (N-1)/2 ‖R Rᵀ - I‖_F, over the rotations that are orthonormal as far as T tells.
    double error_of_rotations = 0;
    std::string name_of_rotations;
    /// The same of the worst band that turns: bands turn apart, so that band l of a result is the turn of a
    /// signal that has energy in band l alone. Over signals whose bands are of like size.
    double error_of_bands = 0;
    std::string name_of_bands;
};
template <class T>
std::vector<Worst> worst_errors(const oracle::Rotation& exact, const std::vector<Problem>& problems,
                                const std::vector<Contestant<T>>& kernels);

/// The largest error b_N that a kernel may have by the project's own contract, for N = 2 … 20 (linear
/// interpolation between the orders that the contract names). `kernel`: rotate, rotate_channels,
/// rotate_tensor, apply, rotate_accurate, blocks or rotate_zhf.
double contract(const std::string& kernel, int order, bool is_float);

}  // namespace zonal::accuracy
