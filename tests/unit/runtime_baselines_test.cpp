// The baselines against the pointwise oracle: what a kernel is compared with must itself be right.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bench/baselines/dense_product.hpp"
#include "bench/baselines/euler_zyz.hpp"
#include "bench/baselines/ivanic_ruedenberg.hpp"
#include "bench/baselines/zxzxz.hpp"
#include "bench/baselines/zyz_without_angles.hpp"
#include "support/hard_cases.hpp"
#include "support/oracle.hpp"

namespace {

namespace baselines = zonal::baselines;
namespace cases = zonal::cases;
namespace oracle = zonal::oracle;

constexpr int kMaxOrder = 20;

/// First-order bound, in eps = 2 u, relative to the vector's norm; a sign or a lost angle costs 1, one half
/// of the digits 1e-8. Euler forms: an angle is wrong by pi eps at most, its multiples up to N - 1 by 1.5 pi
/// N eps: 14 N eps for three. Two products by Rx(90), whose rows have N nonzeros: N u sqrt(N) each, below 4.5
/// N eps at N = 20. Recursion: a row of a band is five products of rows of the last, of combined length 1: 9
/// eps a band; then one product of 2 N terms: 2 N u sqrt(2 N), below 6.4 N eps.
template <class T>
double tolerance(int order) {
    return 20.0 * order * static_cast<double>(std::numeric_limits<T>::epsilon());
}

/// The same of z-y-z without angles. A column's length is wrong by eps, sine and cosine so by 2 eps; the
/// recurrence of multiples enlarges that m^2 times and has roundings of 3 u that grow alike, m^2 / 2
/// times: 2.75 (N - 1)^2 eps an angle.
template <class T>
double zyz_tolerance(int order) {
    const double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
    return tolerance<T>(order) + 9.0 * (order - 1) * (order - 1) * epsilon;
}

/// What sqrt(1 - c^2) loses: 1 - c^2 is wrong by eps, so the root by sqrt(eps) at the most, where it is 0;
/// and N - 1 times that in the multiples of the angle.
template <class T>
double cancelled_tolerance(int order) {
    return (order - 1) * std::sqrt(static_cast<double>(std::numeric_limits<T>::epsilon()));
}

template <class T>
using RotateFunction = std::function<void(const T* R, const T* f, T* out)>;

template <class T>
struct Baseline {
    std::string name;
    bool takes_mirrors;
    bool works_in_place;
    bool bears_noise_at_poles;
    double tolerance;
    RotateFunction<T> rotate;
};

/// zyz_without_angles of an order that is known when the test runs.
template <class T, baselines::SineOfBeta form, int N = 2>
RotateFunction<T> zyz_of(int order) {
    if (order == N) return baselines::zyz_without_angles<N, form, T>;
    if constexpr (N < baselines::kLastZyzOrder) return zyz_of<T, form, N + 1>(order);
    return nullptr;
}

template <class T>
std::vector<Baseline<T>> baselines_of(int order) {
    const auto recursion = std::make_shared<baselines::IvanicRuedenberg<T>>(order);
    const auto euler = std::make_shared<baselines::EulerZyz<T>>(order);
    const auto zxzxz = std::make_shared<baselines::Zxzxz<T>>(order);
    const double usual = tolerance<T>(order);
    std::vector<Baseline<T>> all{
        {"Ivanic-Ruedenberg", true, true, true, usual,
         [=](const T* R, const T* f, T* out) { recursion->rotate(R, f, out); }},
        {"dense product", true, false, true, usual,
         [=](const T* R, const T* f, T* out) {
             std::vector<T> dense(baselines::block_offset(order));
             recursion->blocks(R, dense.data());
             baselines::apply_blocks(order, dense.data(), f, out);
         }},
        {"z-y-z Euler", false, true, true, usual,
         [=](const T* R, const T* f, T* out) { euler->rotate(R, f, out); }},
        {"zxzxz", false, true, true, usual,
         [=](const T* R, const T* f, T* out) { zxzxz->rotate(R, f, out); }},
    };
    using enum baselines::SineOfBeta;
    if (const auto rotate = zyz_of<T, length_of_column>(order))
        all.push_back({"z-y-z without angles", false, true, false, zyz_tolerance<T>(order), rotate});
    if (const auto rotate = zyz_of<T, root_of_cosine>(order))
        all.push_back({"z-y-z as DirectXMath", false, true, false,
                       zyz_tolerance<T>(order) + cancelled_tolerance<T>(order), rotate});
    return all;
}

/// ||out - wanted|| / ||wanted||: a rotation keeps the norm.
template <class T>
double relative_error(const std::vector<T>& out, const std::vector<oracle::Real>& wanted) {
    oracle::Real difference = 0, norm = 0;
    for (std::size_t i = 0; i < out.size(); ++i) {
        difference += (out[i] - wanted[i]) * (out[i] - wanted[i]);
        norm += wanted[i] * wanted[i];
    }
    return static_cast<double>(std::sqrt(difference / norm));
}

double determinant(const cases::Matrix& m) {
    return m[0] * (m[4] * m[8] - m[5] * m[7]) - m[1] * (m[3] * m[8] - m[5] * m[6]) +
           m[2] * (m[3] * m[7] - m[4] * m[6]);
}

/// Random rotations and a few of each hard kind that is orthonormal to rounding: permutations, half turns,
/// mirrors, tilts from both poles, products that are z rotations up to noise.
template <class T>
std::vector<cases::Case> some_rotations(std::mt19937_64& random) {
    constexpr int kOfEachKind = 3, kTilts = 10;
    std::vector<cases::Case> result;
    for (int k = 0; k < kOfEachKind; ++k) result.push_back({"random", cases::random_rotation(random)});
    std::vector<cases::Case> hard = cases::hard_rotations<T>(random);
    std::erase_if(hard, [](const cases::Case& c) { return c.name.starts_with("orthonormal only"); });
    std::ranges::shuffle(hard, random);
    std::map<std::string, int> taken;
    for (const cases::Case& c : hard)
        if (taken[c.name]++ < (c.name.starts_with("tilt") ? kTilts : kOfEachKind)) result.push_back(c);
    return result;
}

template <class T>
class runtime_baselines : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(runtime_baselines, Scalars);

TYPED_TEST(runtime_baselines, every_order_matches_the_pointwise_oracle) {
    using T = TypeParam;
    std::mt19937_64 random(1);
    for (int order = 1; order <= kMaxOrder; ++order) {
        const oracle::Rotation exact(order);
        const auto all = baselines_of<T>(order);
        for (const cases::Case& c : some_rotations<T>(random)) {
            const std::vector<T> R(c.rotation.begin(), c.rotation.end());
            const std::vector<double> signal = cases::random_signal(order, random);
            const std::vector<T> f(signal.begin(), signal.end());
            oracle::Matrix3 given;
            std::ranges::copy(R, given.begin());
            const std::vector<oracle::Real> wanted = exact(given, {f.begin(), f.end()});
            const double excused = (order - 1) * static_cast<double>(oracle::orthonormality_error(given)) / 2;
            for (const Baseline<T>& baseline : all) {
                if (!baseline.takes_mirrors && determinant(c.rotation) < 0) continue;
                if (!baseline.bears_noise_at_poles && c.name.starts_with("product of rounded matrices"))
                    continue;
                std::vector<T> out(f.size());
                baseline.rotate(R.data(), f.data(), out.data());
                EXPECT_LE(relative_error<T>(out, wanted), baseline.tolerance + excused)
                    << baseline.name << ", order " << order << ", " << c.name;
            }
        }
    }
}

TYPED_TEST(runtime_baselines, in_place_gives_the_same_values) {
    using T = TypeParam;
    std::mt19937_64 random(2);
    const cases::Matrix rotation = cases::random_rotation(random);
    const std::vector<T> R(rotation.begin(), rotation.end());
    for (const int order : {1, 2, 7, kMaxOrder}) {
        const std::vector<double> signal = cases::random_signal(order, random);
        for (const Baseline<T>& baseline : baselines_of<T>(order)) {
            if (!baseline.works_in_place) continue;
            std::vector<T> same(signal.begin(), signal.end()), separate(signal.size());
            baseline.rotate(R.data(), same.data(), separate.data());
            baseline.rotate(R.data(), same.data(), same.data());
            EXPECT_EQ(same, separate) << baseline.name << ", order " << order;
        }
    }
}

}  // namespace
