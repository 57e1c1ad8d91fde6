#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/hard_cases.hpp"
#include "support/oracle.hpp"

namespace zonal::accuracy {

/// How far one result is from the truth, as the published bounds count it.
struct Error {
    double relative = 0;  ///< ‖result - exact‖₂ / ‖f‖₂
    double excused = 0;   ///< (N-1) ½ ‖R Rᵀ - I‖_F, what R itself lacks

    double beyond_excused() const { return relative - excused; }
};

/// Compares a result with the oracle's rotation of `f` by the orthonormal matrix nearest to `rotation`.
Error compare(int order, const oracle::Rotation& exact, const oracle::Matrix3& rotation,
              const std::vector<oracle::Real>& f, const std::vector<oracle::Real>& result);

/// Runs `rotate(R, f, out)` in T, on a case rounded to T, and compares.
template <class T, class Rotate>
Error measure(int order, const oracle::Rotation& exact, const cases::Matrix& rotation,
              const std::vector<double>& signal, Rotate rotate) {
    T r[9];
    std::copy(rotation.begin(), rotation.end(), r);
    std::vector<T> f(signal.begin(), signal.end()), out(signal.size());
    rotate(r, f.data(), out.data());
    oracle::Matrix3 given;
    std::copy(r, r + 9, given.begin());
    return compare(order, exact, given, {f.begin(), f.end()}, {out.begin(), out.end()});
}

/// The worst error of `rotate` in T over `random_count` random rotations and the hard ones, each with a
/// random signal, and over the hard signals. `name_of_worst` tells where it was met.
struct Worst {
    double beyond_excused = 0;
    std::string name;
};
template <class T, class Rotate>
Worst worst_error(int order, int random_count, std::uint64_t seed, Rotate rotate) {
    std::mt19937_64 random(seed);
    const oracle::Rotation exact(order);
    Worst worst;
    const auto visit = [&](const std::string& name, const cases::Matrix& rotation,
                           const std::vector<double>& f) {
        const double error = measure<T>(order, exact, rotation, f, rotate).beyond_excused();
        if (!(error <= worst.beyond_excused)) worst = {error, name};  // also when it is NaN
    };
    for (int k = 0; k < random_count; ++k)
        visit("random rotation", cases::random_rotation(random), cases::random_signal(order, random));
    for (const cases::Case& hard : cases::hard_rotations<T>(random))
        visit(hard.name, hard.rotation, cases::random_signal(order, random));
    for (const std::vector<double>& f : cases::hard_signals(order, random))
        for (int k = 0; k < 20; ++k) visit("hard signal", cases::random_rotation(random), f);
    return worst;
}

/// The largest error b_N that `rotate_zhf` may have by the project's own contract, for N = 3 … 20 (linear
/// interpolation between the orders that the contract names).
double zhf_contract(int order, bool is_float);

}  // namespace zonal::accuracy
