// C++ of orders that are not committed, written by zonal-gen while this is built, against the pointwise
// oracle. `rotate_accurate` and `blocks` are a recursion in loops here, and nowhere in what is committed.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

#include "support/accuracy.hpp"
#include "support/banner.hpp"
#include "support/counting.hpp"
#include "support/hard_cases.hpp"
#include "zonal/order12.hpp"
#include "zonal/order20/rotate_accurate.hpp"

namespace zonal::order12 {
namespace {

/// Within the bounds that the header publishes for the type.
template <class T>
void expect_within_bounds(double rotate_bound, double apply_bound, double zhf_bound, double accurate_bound) {
    constexpr int kOrder = 12;
    // The oracle's time grows as order^4.
    constexpr int kRandomRotations = 3, kThinning = 1000;
    constexpr std::uint64_t kSeed = 60;
    const auto halves = [](const T* R, const T* f, T* out) {
        T scalars[kScalars];
        prepare(R, scalars);
        apply(scalars, f, out);
    };
    const double bounds[] = {rotate_bound, apply_bound, zhf_bound, accurate_bound};
    std::vector<accuracy::Contestant<T>> kernels{
        {"rotate", [](const T* R, const T* f, T* out) { rotate(R, f, out); }, kRotateExcess},
        {"apply", halves, kApplyExcess},
        {"rotate_zhf", [](const T* R, const T* f, T* out) { rotate_zhf(R, f, out); }, kRotateZhfExcess},
        {"rotate_accurate", [](const T* R, const T* f, T* out) { rotate_accurate(R, f, out); },
         kRotateAccurateExcess}};
    for (std::size_t k = 0; k < 3; ++k) kernels[k] = accuracy::with_mirrors(kOrder, kernels[k]);
    const auto worst = accuracy::worst_errors<T>(
        oracle::Rotation(kOrder), accuracy::problems<T>(kOrder, kRandomRotations, kThinning, kSeed), kernels);
    for (std::size_t k = 0; k < kernels.size(); ++k)
        EXPECT_LE(worst[k].error, bounds[k]) << kernels[k].name << ", " << worst[k].name;
}

TEST(HighOrder, float_is_within_its_bounds) {
    expect_within_bounds<float>(kRotateBoundFloat, kApplyBoundFloat, kRotateZhfBoundFloat,
                                kRotateAccurateBoundFloat);
}

TEST(HighOrder, double_is_within_its_bounds) {
    expect_within_bounds<double>(kRotateBoundDouble, kApplyBoundDouble, kRotateZhfBoundDouble,
                                 kRotateAccurateBoundDouble);
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
    rotate_zhf(R_.data(), f_.data(), turned_.data());
    in_place = f_;
    rotate_zhf(R_.data(), in_place.data(), in_place.data());
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

/// Banners count the loops, not the graph's straight lines.
TEST_F(Loops, cost_what_their_banners_say) {
    const std::vector<Counting> R(9, Counting(0.5)), f(kCount, Counting(1));
    std::vector<Counting> out(12 * (4 * kCount - 1) / 3, Counting(0));
    const auto text = [](const Tally& tally) {
        return fmt::format("{} mul {} add {} fma {} other", tally.mul, tally.add, tally.fma, tally.other);
    };
    const std::string folder = ZONAL_KERNELS_AT_BUILD;
    Counting::tally = {};
    rotate_accurate(R.data(), f.data(), out.data());
    EXPECT_EQ(text(Counting::tally), banner::cost_in(folder, 12, "rotate_accurate").one);
    Counting::tally = {};
    blocks(R.data(), out.data());
    EXPECT_EQ(text(Counting::tally), banner::cost_in(folder, 12, "blocks").one);
}

TEST_F(Loops, keep_a_value_that_is_not_finite_in_its_band) {
    for (const int band : {3, 11}) {
        std::vector<double> f = f_, out(kCount);
        f[band * band] = std::numeric_limits<double>::quiet_NaN();
        rotate_accurate(R_.data(), f.data(), out.data());
        for (int i = 0; i < kCount; ++i) {
            const bool is_in_band = band * band <= i && i < (band + 1) * (band + 1);
            EXPECT_EQ(std::isnan(out[i]), is_in_band) << i;
        }
    }
}

}  // namespace
}  // namespace zonal::order12

namespace zonal::order20 {
namespace {

/// The highest order, where rounding has had most bands to grow in.
template <class T>
void expect_recursion_within_bounds(double bound) {
    const accuracy::Contestant<T> accurate{"rotate_accurate",
                                           [](const T* R, const T* f, T* out) { rotate_accurate(R, f, out); },
                                           kRotateAccurateExcess};
    const auto worst =
        accuracy::worst_errors<T>(oracle::Rotation(20), accuracy::problems<T>(20, 2, 4000, 62), {accurate});
    EXPECT_LE(worst.front().error, bound) << worst.front().name;
}

TEST(HighestOrder, recursion_in_float_is_within_its_bound) {
    expect_recursion_within_bounds<float>(kRotateAccurateBoundFloat);
}
TEST(HighestOrder, recursion_in_double_is_within_its_bound) {
    expect_recursion_within_bounds<double>(kRotateAccurateBoundDouble);
}

}  // namespace
}  // namespace zonal::order20
