// C++ of orders that are not committed, written by zonal-gen while this is built, against the pointwise
// oracle.
#include <gtest/gtest.h>

#include "support/accuracy.hpp"
#include "zonal/order12.hpp"
#include "zonal/order20.hpp"

namespace zonal {
namespace {

template <class T>
struct Judged {
    accuracy::Contestant<T> kernel;
    double bound;
};

/// Within the bounds that the header publishes.
template <class T>
void expect_within_bounds(int order, const std::vector<Judged<T>>& all) {
    // The oracle's time grows as order^4.
    constexpr int kRandomRotations = 3, kThinning = 1000;
    const auto problems = accuracy::problems<T>(order, kRandomRotations, kThinning, 5 * order);
    std::vector<accuracy::Contestant<T>> kernels;
    for (const Judged<T>& some : all) kernels.push_back(accuracy::with_mirrors(order, some.kernel));
    const auto worst = accuracy::worst_errors<T>(oracle::Rotation(order), problems, kernels);
    for (std::size_t k = 0; k < all.size(); ++k)
        EXPECT_LE(worst[k].error, all[k].bound) << kernels[k].name << ", " << worst[k].name;
}

template <class T>
void expect_order_12_within_bounds() {
    using namespace order12;
    constexpr bool kIsFloat = std::is_same_v<T, float>;
    const auto halves = [](const T* R, const T* f, T* out) {
        T scalars[kScalars];
        prepare(R, scalars);
        apply(scalars, f, out);
    };
    expect_within_bounds<T>(
        12, {{{"rotate", [](const T* R, const T* f, T* out) { rotate(R, f, out); }, kRotateExcess},
              kIsFloat ? kRotateBoundFloat : kRotateBoundDouble},
             {{"apply", halves, kApplyExcess}, kIsFloat ? kApplyBoundFloat : kApplyBoundDouble},
             {{"rotate_accurate", [](const T* R, const T* f, T* out) { rotate_accurate(R, f, out); },
               kRotateAccurateExcess},
              kIsFloat ? kRotateAccurateBoundFloat : kRotateAccurateBoundDouble}});
}

TEST(HighOrder, order_12_in_float_is_within_its_bounds) { expect_order_12_within_bounds<float>(); }
TEST(HighOrder, order_12_in_double_is_within_its_bounds) { expect_order_12_within_bounds<double>(); }

TEST(HighOrder, order_20_is_within_its_bound) {
    using namespace order20;
    const auto turn = [](const float* R, const float* f, float* out) { rotate(R, f, out); };
    expect_within_bounds<float>(20, {{{"rotate", turn, kRotateExcess}, kRotateBoundFloat}});
}

}  // namespace
}  // namespace zonal
