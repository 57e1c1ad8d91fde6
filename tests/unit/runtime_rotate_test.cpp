#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "support/banner.hpp"
#include "support/oracle.hpp"
#include "zonal/conventions.hpp"
#include "zonal/eigen.hpp"
#include "zonal/error.hpp"
#include "zonal/rotate.hpp"

namespace {

using zonal::Rgb;
using zonal::RotationMatrix;

constexpr int kMissingOrder = 21;

int smallest_order() { return zonal::compiled_orders().front(); }

std::size_t length(int order) { return static_cast<std::size_t>(order) * order; }

/// Unequal weights in every coefficient, so that no sign mistake cancels.
template <class T>
std::vector<T> asymmetric_signal(int order, unsigned seed = 1) {
    std::mt19937 generator(seed);
    std::vector<T> signal(length(order));
    for (T& value : signal) value = static_cast<T>(generator()) / static_cast<T>(generator.max()) - T(0.5);
    return signal;
}

template <class T>
double norm(const std::vector<T>& values) {
    double sum = 0;
    for (const T value : values) sum += static_cast<double>(value) * static_cast<double>(value);
    return std::sqrt(sum);
}

template <class T>
zonal::oracle::Matrix3 as_given(const RotationMatrix<T>& rotation) {
    zonal::oracle::Matrix3 given;
    std::copy_n(rotation.data(), 9, given.begin());
    return given;
}

/// What is published of the error of one channel or of three, relative to the norm of the signal; what is not
/// orthonormal in R included.
template <class T>
double bound(int order, const RotationMatrix<T>& rotation) {
    double largest = 0;
    for (const char* kernel : {"rotate", order <= 3 ? "rotate" : "rotate_channels"}) {
        const zonal::banner::Bound published = zonal::banner::bound(order, kernel);
        const double excused =
            published.excess * static_cast<double>(zonal::oracle::orthonormality_error(as_given(rotation)));
        largest = std::max(
            largest, (sizeof(T) == sizeof(float) ? published.float_bound : published.double_bound) + excused);
    }
    return largest;
}

Eigen::Matrix3d asymmetric_rotation() {
    return Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -2, 3).normalized()).toRotationMatrix();
}

/// f'(w) = f(R^T w) at a few directions in general position: needs no rotation of coefficients.
template <class T>
void expect_matches_pointwise_oracle(int order, const Eigen::Matrix3d& matrix) {
    using namespace zonal::oracle;
    const std::vector<T> in = asymmetric_signal<T>(order);
    std::vector<T> out(in.size());
    const RotationMatrix<T> rotation(matrix);
    zonal::rotate(order, rotation, in, out);
    const Matrix3 R = nearest_orthonormal(as_given(rotation));
    // Squares of the N^2 functions at a point sum to N^2 / 4 pi.
    const double tolerance = bound(order, rotation) * norm(in) * order / std::sqrt(4 * std::numbers::pi);
    for (const auto& [x, y, z] :
         {Vector3{1.0L, 0.2L, 0.3L}, {-0.4L, 1.0L, -0.7L}, {0.1L, -0.5L, 1.0L}, {-1.0L, -2.0L, -3.0L}}) {
        const Real length = std::hypot(x, y, z);
        const Vector3 w{x / length, y / length, z / length};
        const Vector3 back{R[0] * w[0] + R[3] * w[1] + R[6] * w[2], R[1] * w[0] + R[4] * w[1] + R[7] * w[2],
                           R[2] * w[0] + R[5] * w[1] + R[8] * w[2]};
        const Real wanted = evaluate(order, {in.begin(), in.end()}, back);
        const Real found = evaluate(order, {out.begin(), out.end()}, w);
        EXPECT_NEAR(static_cast<double>(found - wanted), 0, tolerance) << "order " << order;
    }
}

std::string message_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const zonal::Error& error) {
        return error.what();
    }
    return "no error";
}

template <class T>
class runtime_rotate : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(runtime_rotate, Scalars);

TYPED_TEST(runtime_rotate, identity_returns_input) {
    for (const int order : zonal::compiled_orders()) {
        const auto in = asymmetric_signal<TypeParam>(order);
        std::vector<TypeParam> out(in.size());
        zonal::rotate(order, RotationMatrix<TypeParam>(), in, out);
        const double tolerance = bound(order, RotationMatrix<TypeParam>()) * norm(in);
        for (std::size_t i = 0; i < in.size(); ++i)
            EXPECT_NEAR(out[i], in[i], tolerance) << "order " << order << ", index " << i;
    }
}

TYPED_TEST(runtime_rotate, column_major_eigen_matrix_turns_x_into_y) {
    Eigen::Matrix3d column_major;
    column_major << 0, -1, 0, 1, 0, 0, 0, 0, 1;
    constexpr int kY = 1;  // index l(l+1)+m for l = 1, m = -1
    constexpr int kX = 3;  // m = +1
    for (const int order : zonal::compiled_orders()) {
        if (order < 2) continue;
        std::vector<TypeParam> in(length(order));
        in[kX] = 1;
        std::vector<TypeParam> wanted(length(order));
        wanted[kY] = 1;
        std::vector<TypeParam> out(length(order));
        const RotationMatrix<TypeParam> rotation(column_major);
        zonal::rotate(order, rotation, in, out);
        const double tolerance = bound(order, rotation);
        for (std::size_t i = 0; i < out.size(); ++i)
            EXPECT_NEAR(out[i], wanted[i], tolerance) << "order " << order << ", index " << i;
    }
}

TYPED_TEST(runtime_rotate, rotation_matches_pointwise_oracle) {
    for (const int order : zonal::compiled_orders()) {
        expect_matches_pointwise_oracle<TypeParam>(order, asymmetric_rotation());
    }
}

TYPED_TEST(runtime_rotate, mirror_matches_pointwise_oracle) {
    const Eigen::Matrix3d mirror = asymmetric_rotation() * Eigen::Vector3d(1, -1, 1).asDiagonal();
    for (const int order : zonal::compiled_orders())
        expect_matches_pointwise_oracle<TypeParam>(order, mirror);
}

TYPED_TEST(runtime_rotate, each_rgb_channel_turns_like_a_single_one) {
    const RotationMatrix<TypeParam> rotation(asymmetric_rotation());
    for (const int order : zonal::compiled_orders()) {
        const auto red = asymmetric_signal<TypeParam>(order, 1);
        const auto green = asymmetric_signal<TypeParam>(order, 2);
        const auto blue = asymmetric_signal<TypeParam>(order, 3);
        std::vector<Rgb<TypeParam>> in;
        for (std::size_t i = 0; i < red.size(); ++i) in.push_back({red[i], green[i], blue[i]});
        std::vector<Rgb<TypeParam>> out(in.size());
        zonal::rotate(order, rotation, in, out);

        std::vector<TypeParam> red_out(red.size()), green_out(red.size()), blue_out(red.size());
        zonal::rotate(order, rotation, red, red_out);
        zonal::rotate(order, rotation, green, green_out);
        zonal::rotate(order, rotation, blue, blue_out);
        const double tolerance = 2 * bound(order, rotation);  // two kernels from order 4 on
        for (std::size_t i = 0; i < out.size(); ++i) {
            EXPECT_NEAR(out[i].r, red_out[i], tolerance * norm(red)) << "order " << order;
            EXPECT_NEAR(out[i].g, green_out[i], tolerance * norm(green)) << "order " << order;
            EXPECT_NEAR(out[i].b, blue_out[i], tolerance * norm(blue)) << "order " << order;
        }
    }
}

TYPED_TEST(runtime_rotate, in_place_gives_the_same_values) {
    const RotationMatrix<TypeParam> rotation(asymmetric_rotation());
    for (const int order : zonal::compiled_orders()) {
        auto signal = asymmetric_signal<TypeParam>(order);
        std::vector<TypeParam> separate(signal.size());
        zonal::rotate(order, rotation, signal, separate);
        zonal::rotate(order, rotation, signal, signal);
        EXPECT_EQ(signal, separate) << "order " << order;
    }
}

TYPED_TEST(runtime_rotate, nan_stays_within_its_band) {
    const RotationMatrix<TypeParam> rotation(asymmetric_rotation());
    for (const int order : zonal::compiled_orders()) {
        auto in = asymmetric_signal<TypeParam>(order);
        in.back() = std::numeric_limits<TypeParam>::quiet_NaN();
        std::vector<TypeParam> out(in.size());
        zonal::rotate(order, rotation, in, out);
        const auto last_band = out.begin() + (order - 1) * (order - 1);
        EXPECT_TRUE(std::all_of(out.begin(), last_band, [](TypeParam v) { return std::isfinite(v); }))
            << "order " << order;
        EXPECT_TRUE(std::any_of(last_band, out.end(), [](TypeParam v) { return std::isnan(v); }))
            << "order " << order;
    }
}

/// Other tests run over them: one that is gone would pass them unseen.
TEST(runtime_rotate_door, compiled_orders_are_those_that_are_built) {
    const auto orders = zonal::compiled_orders();
    EXPECT_EQ(std::vector<int>(orders.begin(), orders.end()), (std::vector<int>{ZONAL_TEST_ORDERS}));
}

TEST(runtime_rotate_door, order_that_is_not_compiled_names_those_that_are) {
    std::vector<float> signal(length(kMissingOrder));
    const std::string message =
        message_of([&] { zonal::rotate(kMissingOrder, RotationMatrix<float>(), signal, signal); });
    std::string list;
    for (const int order : zonal::compiled_orders())
        list += (list.empty() ? "" : ", ") + std::to_string(order);
    EXPECT_NE(message.find("order: found 21"), std::string::npos) << message;
    EXPECT_NE(message.find("compiled in: " + list + ";"), std::string::npos) << message;
}

TEST(runtime_rotate_door, negative_order_is_refused) {
    std::vector<float> signal(9);
    const std::string message =
        message_of([&] { zonal::rotate(-3, RotationMatrix<float>(), signal, signal); });
    EXPECT_NE(message.find("order: found -3"), std::string::npos) << message;
}

TEST(runtime_rotate_door, span_of_wrong_length_is_named_with_both_lengths) {
    const int order = smallest_order();
    std::vector<double> right(length(order));
    std::vector<double> wrong(length(order) + 1);
    const std::string tail = " for order " + std::to_string(order) + ": found " +
                             std::to_string(wrong.size()) + ", wanted " + std::to_string(right.size());
    const std::string in_message =
        message_of([&] { zonal::rotate(order, RotationMatrix<double>(), wrong, right); });
    EXPECT_NE(in_message.find("length of in" + tail), std::string::npos) << in_message;
    const std::string out_message =
        message_of([&] { zonal::rotate(order, RotationMatrix<double>(), right, wrong); });
    EXPECT_NE(out_message.find("length of out" + tail), std::string::npos) << out_message;
}

TYPED_TEST(runtime_rotate, three_interleaved_channels_of_values_turn_like_colours) {
    using T = TypeParam;
    const RotationMatrix<T> rotation(asymmetric_rotation());
    for (const int order : zonal::compiled_orders()) {
        const std::vector<T> in = asymmetric_signal<T>(2 * order);  // more than enough
        std::vector<Rgb<T>> colours(length(order)), wanted(colours.size());
        for (std::size_t i = 0; i < colours.size(); ++i)
            colours[i] = {in[3 * i], in[3 * i + 1], in[3 * i + 2]};
        zonal::rotate(order, rotation, colours, wanted);
        const std::span<const T> values = std::span(in).first(3 * length(order));
        std::vector<T> out(values.size());
        zonal::rotate(order, rotation, values, out);
        for (std::size_t i = 0; i < wanted.size(); ++i)
            EXPECT_EQ((Rgb<T>(out[3 * i], out[3 * i + 1], out[3 * i + 2])), wanted[i]) << "coefficient " << i;
        zonal::rotate(zonal::Convention::kGoogle, order, rotation, std::span<const Rgb<T>>(colours),
                      std::span(wanted));
        zonal::rotate(zonal::Convention::kGoogle, order, rotation, values, std::span(out));
        for (std::size_t i = 0; i < wanted.size(); ++i) EXPECT_EQ(out[3 * i], wanted[i].r);
    }
}

TEST(runtime_rotate_door, several_channels_or_vectors_are_told_what_takes_them) {
    const int order = smallest_order();
    const std::vector<float> in(5 * length(order));
    std::vector<float> out(in.size());
    const std::string message = message_of([&] { zonal::rotate(order, RotationMatrix<float>(), in, out); });
    EXPECT_NE(message.find("zonal::Rgb"), std::string::npos) << message;
    EXPECT_NE(message.find("zonal/batch.hpp"), std::string::npos) << message;
}

TEST(runtime_rotate_door, partial_overlap_is_refused_and_leaves_the_values) {
    const int order = smallest_order();
    std::vector<float> storage(length(order) + 1, 7.0F);
    const std::span<float> all(storage);
    const auto head = all.first(length(order));
    const auto tail = all.last(length(order));
    const RotationMatrix<float> rotation(asymmetric_rotation());
    EXPECT_NE(message_of([&] { zonal::rotate(order, rotation, head, tail); }).find("overlap in part"),
              std::string::npos);
    EXPECT_NE(message_of([&] { zonal::rotate(order, rotation, tail, head); }).find("overlap in part"),
              std::string::npos);
    EXPECT_EQ(storage, std::vector<float>(storage.size(), 7.0F));
}

TEST(runtime_rotate_door, neighbouring_spans_do_not_overlap) {
    const int order = smallest_order();
    std::vector<float> storage(2 * length(order), 1.0F);
    const std::span<float> all(storage);
    EXPECT_NO_THROW(
        zonal::rotate(order, RotationMatrix<float>(), all.first(length(order)), all.last(length(order))));
}

}  // namespace
