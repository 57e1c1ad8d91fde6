// C++ of an order that is not committed, written by zonal-gen while this is built, against the pointwise
// oracle.
#include <gtest/gtest.h>

#include "support/accuracy.hpp"
#include "zonal/order12.hpp"

namespace zonal::order12 {
namespace {

/// Within the bounds that the header publishes for the type.
template <class T>
void expect_within_bounds(double rotate_bound, double apply_bound, double accurate_bound) {
    constexpr int kOrder = 12;
    // The oracle's time grows as order^4.
    constexpr int kRandomRotations = 3, kThinning = 1000;
    constexpr std::uint64_t kSeed = 60;
    const auto halves = [](const T* R, const T* f, T* out) {
        T scalars[kScalars];
        prepare(R, scalars);
        apply(scalars, f, out);
    };
    const double bounds[] = {rotate_bound, apply_bound, accurate_bound};
    std::vector<accuracy::Contestant<T>> kernels{
        {"rotate", [](const T* R, const T* f, T* out) { rotate(R, f, out); }, kRotateExcess},
        {"apply", halves, kApplyExcess},
        {"rotate_accurate", [](const T* R, const T* f, T* out) { rotate_accurate(R, f, out); },
         kRotateAccurateExcess}};
    for (auto& kernel : kernels) kernel = accuracy::with_mirrors(kOrder, kernel);
    const auto worst = accuracy::worst_errors<T>(
        oracle::Rotation(kOrder), accuracy::problems<T>(kOrder, kRandomRotations, kThinning, kSeed), kernels);
    for (std::size_t k = 0; k < kernels.size(); ++k)
        EXPECT_LE(worst[k].error, bounds[k]) << kernels[k].name << ", " << worst[k].name;
}

TEST(HighOrder, float_is_within_its_bounds) {
    expect_within_bounds<float>(kRotateBoundFloat, kApplyBoundFloat, kRotateAccurateBoundFloat);
}

TEST(HighOrder, double_is_within_its_bounds) {
    expect_within_bounds<double>(kRotateBoundDouble, kApplyBoundDouble, kRotateAccurateBoundDouble);
}

}  // namespace
}  // namespace zonal::order12
