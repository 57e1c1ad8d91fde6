// Kernels on types that know nothing of zonal: a vector of three channels with sums and scalar products
// alone, and numbers that carry derivatives. And what a user's file includes and uses beside them stays as it
// is.
#include <math.h>

#include "zonal/order03.hpp"
#include "zonal/order04.hpp"
#include "zonal/order05.hpp"
//
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "support/banner.hpp"
#include "support/hard_cases.hpp"
#include "support/oracle.hpp"

using namespace zonal::order4;  // helpers of the header are not among its names

namespace zonal {
namespace {

TEST(UsersNames, stay_unambiguous_beside_a_generated_header) {
    EXPECT_EQ(sqrt(4.0f), 2.0f);
    EXPECT_EQ(copysign(1.0, -2.0), -1.0);
    EXPECT_EQ(fma(2.0f, 3.0f, 4.0f), 10.0f);
}

struct Vec3 {
    float x, y, z;
};
Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
Vec3 operator*(float s, Vec3 a) { return {s * a.x, s * a.y, s * a.z}; }

/// Mirrors too, where the kernel's own words allow them.
template <class RotateOne, class RotateThree>
void expect_channels_turn_alike(int order, const std::string& kernel, RotateOne rotate_one,
                                RotateThree rotate_three) {
    const banner::Bound of_one = banner::bound(order, kernel);
    const banner::Bound of_three =
        kernel != "rotate_accurate" && kernel != "rotate_tensor" && kernel != "rotate_zhf" && order > 3
            ? banner::bound(order, "rotate_channels")
            : of_one;
    const bool takes_mirrors = of_one.takes_mirrors;
    ASSERT_EQ(of_three.takes_mirrors, takes_mirrors);
    std::mt19937_64 random(7);
    for (const double sign : {1.0, -1.0}) {
        if (sign < 0 && !takes_mirrors) continue;
        const cases::Matrix rotation = cases::random_rotation(random);
        float R[9];
        for (int i = 0; i < 9; ++i) R[i] = static_cast<float>(sign * rotation[i]);
        const int size = order * order;
        std::vector<Vec3> f(size), out(size);
        for (Vec3& value : f) {
            std::normal_distribution<float> normal;
            value = {normal(random), normal(random), normal(random)};
        }
        rotate_three(R, f.data(), out.data());
        for (const auto channel : {&Vec3::x, &Vec3::y, &Vec3::z}) {
            std::vector<float> one(size), turned(size);
            for (int i = 0; i < size; ++i) one[i] = f[i].*channel;
            rotate_one(R, one.data(), turned.data());
            float norm = 0;
            for (const float value : one) norm += value * value;
            // Two kernels, each within its published bound.
            oracle::Matrix3 given;
            std::copy(R, R + 9, given.begin());
            const double tolerance =
                of_one.float_bound + of_three.float_bound +
                (of_one.excess + of_three.excess) * static_cast<double>(oracle::orthonormality_error(given));
            for (int i = 0; i < size; ++i)
                EXPECT_NEAR(out[i].*channel, turned[i], tolerance * std::sqrt(norm))
                    << "order " << order << ", sign " << sign;
        }
    }
}

#define ZONAL_EXPECT_ALIKE(N, kernel)                                                                \
    expect_channels_turn_alike(                                                                      \
        N, #kernel, [](const float* R, const float* f, float* out) { order##N::kernel(R, f, out); }, \
        [](const float* R, const Vec3* f, Vec3* out) { order##N::kernel(R, f, out); })

TEST(ForeignVector, of_three_channels_turns_as_each_channel_does) {
    ZONAL_EXPECT_ALIKE(3, rotate);
    ZONAL_EXPECT_ALIKE(3, rotate_accurate);
    ZONAL_EXPECT_ALIKE(3, rotate_zhf);
    ZONAL_EXPECT_ALIKE(4, rotate);
    ZONAL_EXPECT_ALIKE(4, rotate_fewest);
    ZONAL_EXPECT_ALIKE(4, rotate_tensor);
    ZONAL_EXPECT_ALIKE(4, rotate_accurate);
    ZONAL_EXPECT_ALIKE(4, rotate_zhf);
    ZONAL_EXPECT_ALIKE(5, rotate);
    ZONAL_EXPECT_ALIKE(5, rotate_accurate);
}

TEST(ForeignVector, is_factorized_and_expanded_by_scalars_that_are_named) {
    std::vector<Vec3> f(16), z(16), back(16);
    for (int i = 0; i < 16; ++i) f[i] = {static_cast<float>(i), 1, 0};
    order4::factorize<Vec3, float>(f.data(), z.data());
    order4::expand<Vec3, float>(z.data(), back.data());
    // A rotation by `rotate_zhf` is no less than both; each product is judged on its own in
    // lobe_property_test.
    const float norm = std::sqrt(1240.0f);  // 0^2 + ... + 15^2
    for (int i = 0; i < 16; ++i)
        EXPECT_NEAR(back[i].x, f[i].x, static_cast<float>(order4::kRotateZhfBoundFloat) * norm);
}

/// A number and its derivative.
struct Dual {
    double value = 0, slope = 0;
    Dual() = default;
    explicit Dual(double v, double s = 0) : value(v), slope(s) {}
};
Dual operator+(Dual a, Dual b) { return Dual(a.value + b.value, a.slope + b.slope); }
Dual operator-(Dual a, Dual b) { return Dual(a.value - b.value, a.slope - b.slope); }
Dual operator-(Dual a) { return Dual(-a.value, -a.slope); }
Dual operator*(Dual a, Dual b) { return Dual(a.value * b.value, a.slope * b.value + a.value * b.slope); }
Dual operator/(Dual a, Dual b) {
    return Dual(a.value / b.value, (a.slope * b.value - a.value * b.slope) / (b.value * b.value));
}
Dual sqrt(Dual a) { return Dual(std::sqrt(a.value), a.slope / (2 * std::sqrt(a.value))); }
Dual copysign(Dual a, Dual b) {
    return Dual(std::copysign(a.value, b.value),
                std::signbit(a.value) == std::signbit(b.value) ? a.slope : -a.slope);
}

using Kernel = std::function<void(const Dual* R, const Dual* f, Dual* out)>;

/// The largest error of the derivative by a turn about an axis, where the rotation is the identity or one
/// about z: beside central differences of the oracle.
double worst_slope_error(int order, const Kernel& kernel) {
    constexpr double kStep = 1e-5;  // its square is left out: 1e-10 times l^3
    std::mt19937_64 random(11);
    const std::vector<double> f = cases::random_signal(order, random);
    const oracle::Rotation exact(order);
    double worst = 0;
    for (const double angle : {0.0, 0.7}) {
        const cases::Matrix R = cases::about_axis({0, 0, 1}, angle);
        for (const std::array<double, 3>& axis : {std::array<double, 3>{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}) {
            const auto [x, y, z] = axis;
            const cases::Matrix generator{0, -z, y, z, 0, -x, -y, x, 0};
            const cases::Matrix slope = cases::product(generator, R);
            std::vector<Dual> r, in, out(f.size());
            for (int i = 0; i < 9; ++i) r.emplace_back(R[i], slope[i]);
            for (const double value : f) in.emplace_back(value);
            kernel(r.data(), in.data(), out.data());
            const auto turned_by = [&](double step) {
                const cases::Matrix rotation = cases::product(cases::about_axis(axis, step), R);
                oracle::Matrix3 given;
                std::copy(rotation.begin(), rotation.end(), given.begin());
                return exact(given, {f.begin(), f.end()});
            };
            const auto ahead = turned_by(kStep), behind = turned_by(-kStep);
            for (std::size_t i = 0; i < f.size(); ++i) {
                const auto wanted = static_cast<double>((ahead[i] - behind[i]) / (2 * kStep));
                const double error = std::abs(out[i].slope - wanted);
                worst = std::max(worst, std::isnan(error) ? INFINITY : error);
            }
        }
    }
    return worst;
}

#define ZONAL_DUAL(N, kernel) \
    worst_slope_error(N, [](const Dual* R, const Dual* f, Dual* out) { order##N::kernel(R, f, out); })

TEST(Derivatives, are_right_at_the_pole_for_kernels_that_say_so) {
    EXPECT_LT(ZONAL_DUAL(3, rotate), 1e-7);
    EXPECT_LT(ZONAL_DUAL(3, rotate_accurate), 1e-7);
    EXPECT_LT(ZONAL_DUAL(3, rotate_zhf), 1e-7);
    EXPECT_LT(ZONAL_DUAL(3, rotate_tensor), 1e-7);
    EXPECT_LT(ZONAL_DUAL(4, rotate_tensor), 1e-7);
    EXPECT_LT(ZONAL_DUAL(4, rotate_accurate), 1e-7);
    EXPECT_LT(ZONAL_DUAL(4, rotate_zhf), 1e-7);
    EXPECT_LT(ZONAL_DUAL(5, rotate_accurate), 1e-7);
    EXPECT_LT(ZONAL_DUAL(5, rotate_zhf), 1e-7);
}

/// If they come out right one day, the words at the kernel are to change.
TEST(Derivatives, are_wrong_at_the_pole_for_kernels_that_say_not_to) {
    EXPECT_GT(ZONAL_DUAL(4, rotate_fewest), 1e-2);
    EXPECT_GT(ZONAL_DUAL(5, rotate), 1e-2);
}

}  // namespace
}  // namespace zonal
