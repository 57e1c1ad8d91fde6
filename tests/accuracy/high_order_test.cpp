// C++ of an order that is not committed, written by zonal-gen while this is built, against the pointwise
// oracle. `rotate_accurate`, `blocks` and `stable::rotate_zhf` are loops over tables here, and nowhere in
// what is committed.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "support/accuracy.hpp"
#include "support/counting.hpp"
#include "support/hard_cases.hpp"
#include "zonal/order12.hpp"

namespace zonal::order12 {
namespace {

/// Within the bounds that the header publishes for the type.
template <class T>
void expect_within_bounds(double rotate_bound, double apply_bound, double accurate_bound,
                          double stable_bound) {
    constexpr int kOrder = 12;
    // The oracle's time grows as order^4.
    constexpr int kRandomRotations = 3, kThinning = 1000;
    constexpr std::uint64_t kSeed = 60;
    const auto halves = [](const T* R, const T* f, T* out) {
        T scalars[kScalars];
        prepare(R, scalars);
        apply(scalars, f, out);
    };
    const double bounds[] = {rotate_bound, apply_bound, accurate_bound, stable_bound};
    std::vector<accuracy::Contestant<T>> kernels{
        {"rotate", [](const T* R, const T* f, T* out) { rotate(R, f, out); }, kRotateExcess},
        {"apply", halves, kApplyExcess},
        {"rotate_accurate", [](const T* R, const T* f, T* out) { rotate_accurate(R, f, out); },
         kRotateAccurateExcess},
        {"stable::rotate_zhf", [](const T* R, const T* f, T* out) { stable::rotate_zhf(R, f, out); },
         stable::kRotateZhfExcess}};
    for (auto& kernel : kernels) kernel = accuracy::with_mirrors(kOrder, kernel);
    const auto worst = accuracy::worst_errors<T>(
        oracle::Rotation(kOrder), accuracy::problems<T>(kOrder, kRandomRotations, kThinning, kSeed), kernels);
    for (std::size_t k = 0; k < kernels.size(); ++k)
        EXPECT_LE(worst[k].error, bounds[k]) << kernels[k].name << ", " << worst[k].name;
}

TEST(HighOrder, float_is_within_its_bounds) {
    expect_within_bounds<float>(kRotateBoundFloat, kApplyBoundFloat, kRotateAccurateBoundFloat,
                                stable::kRotateZhfBoundFloat);
}

TEST(HighOrder, double_is_within_its_bounds) {
    expect_within_bounds<double>(kRotateBoundDouble, kApplyBoundDouble, kRotateAccurateBoundDouble,
                                 stable::kRotateZhfBoundDouble);
}

class Loops : public testing::Test {
  protected:
    static constexpr int kCount = 12 * 12;

    Loops() : random_(61), R_(cases::random_rotation(random_)), f_(cases::random_signal(12, random_)) {
        rotate_accurate(R_.data(), f_.data(), turned_.data());
    }

    std::mt19937_64 random_;
    cases::Matrix R_;
    std::vector<double> f_, turned_ = std::vector<double>(kCount);
};

TEST_F(Loops, may_write_over_their_input) {
    std::vector<double> in_place = f_;
    rotate_accurate(R_.data(), in_place.data(), in_place.data());
    EXPECT_EQ(in_place, turned_);
    stable::rotate_zhf(R_.data(), f_.data(), turned_.data());
    in_place = f_;
    stable::rotate_zhf(R_.data(), in_place.data(), in_place.data());
    EXPECT_EQ(in_place, turned_);
}

TEST_F(Loops, blocks_times_signal_is_what_rotate_accurate_does) {
    std::vector<double> dense(12 * (4 * kCount - 1) / 3);
    blocks(R_.data(), dense.data());
    const double* row = dense.data();
    for (int l = 0; l < 12; ++l) {
        for (int i = l * l; i < (l + 1) * (l + 1); ++i, row += 2 * l + 1) {
            const double sum = std::inner_product(row, row + 2 * l + 1, f_.begin() + l * l, 0.0);
            // Sums of the same 2l+1 products in another order.
            double size = 0;
            for (int j = 0; j < 2 * l + 1; ++j) size += std::abs(row[j] * f_[l * l + j]);
            EXPECT_NEAR(sum, turned_[i], (2 * l + 1) * std::numeric_limits<double>::epsilon() * size) << i;
        }
    }
}

TEST_F(Loops, take_other_types_of_numbers) {
    std::vector<Counting> R, f, out(kCount);
    for (const double value : R_) R.emplace_back(value);
    for (const double value : f_) f.emplace_back(value);
    rotate_accurate(R.data(), f.data(), out.data());
    // The counting type does not fuse: each result is as wrong as the bound lets either be.
    const double size = std::sqrt(std::inner_product(f_.begin(), f_.end(), f_.begin(), 0.0));
    for (int i = 0; i < kCount; ++i)
        EXPECT_NEAR(out[i].value, turned_[i], 4 * kRotateAccurateBoundDouble * size) << i;
}

}  // namespace
}  // namespace zonal::order12
