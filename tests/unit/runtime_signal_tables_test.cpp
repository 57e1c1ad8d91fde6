#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "support/cube_map.hpp"
#include "support/oracle.hpp"
#include "zonal/eigen.hpp"
#include "zonal/error.hpp"
#include "zonal/orders.hpp"
#include "zonal/rotation.hpp"
#include "zonal/signal_tables.hpp"

namespace {

using Eigen::half;
using Eigen::Vector3d;
using zonal::Rgb;
using zonal::SignalTableOptions;
using zonal::SignalTablePlan;
using zonal::SignalTables;
using zonal::test::FacePoint;
using Signal = std::vector<Rgb<float>>;

constexpr int kBitsOfFloat = 24;

/// Every coefficient another, weaker towards high bands as lighting is.
Signal lighting(int order, unsigned seed = 1) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    Signal signal(order * order);
    for (int l = 0; l < order; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            signal[i] = (1.0f / static_cast<float>(l + 1)) *
                        Rgb<float>{normal(random), normal(random), normal(random)};
    return signal;
}

Signal only_band(int l, Signal signal) {
    for (int i = 0; i < static_cast<int>(signal.size()); ++i)
        if (i < l * l || i >= (l + 1) * (l + 1)) signal[i] = {};
    return signal;
}

double norm(const Signal& signal) {
    double sum = 0;
    for (const auto& [r, g, b] : signal) sum += 1.0 * r * r + 1.0 * g * g + 1.0 * b * b;
    return std::sqrt(sum);
}

std::array<std::vector<zonal::oracle::Real>, 3> channels(const Signal& signal) {
    std::array<std::vector<zonal::oracle::Real>, 3> result;
    for (const auto& [r, g, b] : signal) {
        result[0].push_back(r);
        result[1].push_back(g);
        result[2].push_back(b);
    }
    return result;
}

/// f_l(w) of three channels by the oracle.
std::array<double, 3> exact_sample(int order, int l, const Signal& signal, const Vector3d& w) {
    const auto values = channels(only_band(l, signal));
    const zonal::oracle::Vector3 direction{w.x(), w.y(), w.z()};
    std::array<double, 3> result{};
    for (int c = 0; c < 3; ++c)
        result[c] = static_cast<double>(zonal::oracle::evaluate(order, values[c], direction));
    return result;
}

/// A texture unit: bilinear within a level, coordinates cut to `bits` bits below a texel.
struct Sampler {
    int bits = kBitsOfFloat;

    template <class T>
    std::array<double, 3> operator()(const SignalTables<T>& tables, int layer, Vector3d w) const {
        // What the shader does: all but the largest component are scaled, on edges all but one.
        int largest = 0;
        w.cwiseAbs().maxCoeff(&largest);
        for (int i = 0; i < 3; ++i)
            if (i != largest) w[i] *= zonal::kFaceScale;
        const FacePoint point = zonal::test::project_onto_cube(w);
        const int level = tables.plan.levels[layer], size = tables.plan.size_at(level);
        double x = point.s * size - 0.5, y = point.t * size - 0.5;
        const double rounding = 1e-14 * size;  // the smallest faces have texels on their edges
        EXPECT_TRUE(std::min(x, y) >= -rounding && std::max(x, y) <= size - 1 + rounding)
            << "the filter leaves face " << point.face << " at " << w.transpose();
        x = cut(x, size);
        y = cut(y, size);
        const int column = std::clamp(static_cast<int>(x), 0, size - 2);
        const int row = std::clamp(static_cast<int>(y), 0, size - 2);
        const double a = x - column, b = y - row;
        std::array<double, 3> sum{};
        for (int i = 0; i < 4; ++i) {
            const int down = i / 2, right = i % 2;
            const double weight = (right ? a : 1 - a) * (down ? b : 1 - b);
            const std::size_t texel =
                tables.plan.first_texel(level, layer, point.face) + (row + down) * size + column + right;
            for (int c = 0; c < 3; ++c) sum[c] += weight * static_cast<double>(tables.texels[4 * texel + c]);
        }
        return sum;
    }

    double cut(double coordinate, int size) const {
        return std::clamp(std::ldexp(std::floor(std::ldexp(coordinate, bits)), -bits), 0.0, size - 1.0);
    }
};

/// Random ones, those to corners, edges and centres of a cube, and those just beside.
std::vector<Vector3d> directions(int count) {
    std::vector<Vector3d> result;
    for (const double x : {-1.0, 0.0, 1.0})
        for (const double y : {-1.0, 0.0, 1.0})
            for (const double z : {-1.0, 0.0, 1.0})
                if (x != 0 || y != 0 || z != 0)
                    for (const double aside : {0.0, 1e-7, 0.003})
                        result.push_back(Vector3d(x + aside, y - aside / 2, z + aside / 3).normalized());
    std::mt19937 random(7);
    std::normal_distribution<double> normal;
    while (static_cast<int>(result.size()) < count)
        result.push_back(Vector3d(normal(random), normal(random), normal(random)).normalized());
    return result;
}

TEST(SignalTables, texels_hold_each_band_where_vulkan_looks_for_it) {
    constexpr int kOrder = 6;
    const Signal signal = lighting(kOrder);
    const auto tables = zonal::build_signal_tables<float>(kOrder, signal, {.budget = 0.05});
    const SignalTablePlan& plan = tables.plan;
    ASSERT_EQ(plan.levels.size(), 4u);
    ASSERT_GT(plan.level_count, 1) << "wanted a case with mip levels";
    EXPECT_EQ(tables.texels.size(), 4 * plan.texel_count());
    for (int level = 0; level < plan.level_count; ++level) {
        const int size = plan.size_at(level);
        for (int face = 0; face < 6; ++face) {
            for (const auto& [row, column] :
                 {std::array{0, 0}, {0, size - 1}, {size - 1, 3}, {size / 2, 5}}) {
                const Vector3d w = zonal::face_texel_direction(size, face, row, column);
                // Scaled about the face's centre, it lies at the texel's centre.
                const FacePoint point = zonal::test::project_onto_face(face, w);
                EXPECT_NEAR((point.s - 0.5) * zonal::kFaceScale + 0.5, (column + 0.5) / size, 1e-15);
                EXPECT_NEAR((point.t - 0.5) * zonal::kFaceScale + 0.5, (row + 0.5) / size, 1e-15);
                EXPECT_EQ(w[face / 2] < 0, face % 2 == 1);
                for (int layer = 0; layer < plan.layer_count(); ++layer) {
                    const float* texel =
                        &tables.texels[4 * (plan.first_texel(level, layer, face) + row * size + column)];
                    const auto exact = exact_sample(kOrder, layer + 2, signal, w);
                    for (int c = 0; c < 3; ++c)
                        // Rounded once to float; the double sum behind it is off by 1e-14 at most.
                        EXPECT_NEAR(texel[c], exact[c], std::abs(exact[c]) * 0x1p-24 + 1e-14);
                    EXPECT_EQ(texel[3], 0.0f);
                }
            }
        }
    }
}

TEST(SignalTables, edge_texels_of_the_smallest_faces_lie_on_the_edges_and_are_equal) {
    const auto tables = zonal::build_signal_tables<half>(3, lighting(3), {.budget = 0.5});
    ASSERT_EQ(tables.plan.face_size, zonal::kSmallestFace);
    const int last = zonal::kSmallestFace - 1;
    for (int i = 0; i <= last; ++i) {
        // +x at s = 1 is -z at s = 0; +y at t = 1 is +z at t = 0.
        for (const auto& [face, row, column, other, other_row, other_column] :
             {std::array{0, i, last, 5, i, 0}, {2, last, i, 4, 0, i}}) {
            for (int c = 0; c < 3; ++c)
                EXPECT_EQ(
                    tables.texels[4 * (tables.plan.first_texel(0, 0, face) + row * 32 + column) + c],
                    tables.texels[4 * (tables.plan.first_texel(0, 0, other) + other_row * 32 + other_column) +
                                  c]);
        }
    }
}

/// The bound of one sample as the header derives it, in units of the largest |f_l|.
double sample_bound(int l, int size, int bits, double texel_rounding) {
    const double h = 2 / (zonal::kFaceScale * size);
    double bend = 0;
    for (double u = 0; u <= 1.1; u += 1e-4)
        bend = std::max(bend, (l * l + 2 * l * u) / std::pow(1 + u * u, 2));
    return h * h / 4 * bend + 2 * std::ldexp(h * l, -bits) + texel_rounding;
}

/// Largest error over bound of samples of one band.
template <class T>
double worst_sample(const SignalTables<T>& tables, int l, int bits, double texel_rounding,
                    const std::vector<Vector3d>& places, const std::vector<std::array<double, 3>>& exact,
                    double peak) {
    const int size = tables.plan.size_at(tables.plan.levels[l - 2]);
    const double bound = peak * sample_bound(l, size, bits, texel_rounding);
    double largest = 0;
    for (std::size_t k = 0; k < places.size(); ++k) {
        const auto sample = Sampler{bits}(tables, l - 2, places[k]);
        const double error =
            std::hypot(sample[0] - exact[k][0], sample[1] - exact[k][1], sample[2] - exact[k][2]);
        EXPECT_LE(error, bound) << "band " << l << ", faces of " << size << ", at " << places[k].transpose();
        largest = std::max(largest, error / bound);
    }
    return largest;
}

/// The orders whose lobes are compiled in: fewer under the sanitizers.
const std::vector<int>& lobe_orders() {
#define ZONAL_LIST_ENTRY(N) N,
    static const std::vector<int> orders{ZONAL_FOR_EACH_LOBE_ORDER(ZONAL_LIST_ENTRY)};
#undef ZONAL_LIST_ENTRY
    return orders;
}

template <class T>
void check_samples(double texel_rounding) {
    const int order = lobe_orders().back();
    constexpr int kLargestFace = 150;  // more takes longer and shows nothing new
    const std::vector<Vector3d> places = directions(150);
    double largest_share = 0;
    for (int l = 2; l < order; ++l) {
        const Signal signal = only_band(l, lighting(order, l));
        const double peak = std::sqrt((2 * l + 1) / (4 * std::numbers::pi)) * norm(signal);
        std::vector<std::array<double, 3>> exact;
        for (const Vector3d& w : places) exact.push_back(exact_sample(order, l, signal, w));
        std::set<int> sizes;
        for (const double share : {2.0, 0.4, 0.1, 0.05}) {
            const double budget = share * l * l / 25;  // higher bands, larger faces for the same error
            for (const int bits : {4, 8}) {
                const SignalTableOptions options{.budget = budget, .subtexel_bits = bits};
                const int size = zonal::plan_signal_tables<T>(order, signal, options).face_size;
                if (size > kLargestFace || !sizes.insert(size).second) continue;
                const auto tables = zonal::build_signal_tables<T>(order, signal, options);
                largest_share = std::max(largest_share,
                                         worst_sample(tables, l, bits, texel_rounding, places, exact, peak));
            }
        }
        EXPECT_GE(sizes.size(), 2u) << "band " << l;
    }
    // A bound that nothing comes near would hide a wrong one.
    EXPECT_GT(largest_share, 0.1);
}

TEST(SignalTables, samples_are_within_the_bound_with_float_texels) { check_samples<float>(0x1p-23); }
TEST(SignalTables, samples_are_within_the_bound_with_half_texels) { check_samples<half>(0x1p-11 + 0x1p-23); }

/// zonal::orderN::lobes and resample, of the orders compiled in.
void lobes(int order, const float* rotation, float* directions) {
    switch (order) {
#define ZONAL_CASE(N) \
    case N:           \
        return zonal::order##N::lobes<float>(rotation, directions);
        ZONAL_FOR_EACH_LOBE_ORDER(ZONAL_CASE)
#undef ZONAL_CASE
    }
}
void resample(int order, const Rgb<float>* samples, Rgb<float>* out) {
    switch (order) {
#define ZONAL_CASE(N) \
    case N:           \
        return zonal::order##N::resample<Rgb<float>>(samples, out);
        ZONAL_FOR_EACH_LOBE_ORDER(ZONAL_CASE)
#undef ZONAL_CASE
    }
}

/// Â_l times samples that are all off by 1, with the worst of some signs.
double largest_change(int order, int l) {
    std::mt19937 random(11);
    double largest = 0;
    for (int k = 0; k < 300; ++k) {
        Signal samples(order * order), out(order * order);
        for (int i = l * l; i < (l + 1) * (l + 1); ++i) samples[i].r = random() % 2 == 0 ? 1.0f : -1.0f;
        resample(order, samples.data(), out.data());
        largest = std::max(largest, norm(out));
    }
    return largest;
}

TEST(SignalTables, a_bands_bound_is_that_of_its_samples_times_what_the_lobes_make_of_it) {
    constexpr int kOrder = 6;
    const Signal signal = lighting(kOrder);
    for (const double budget : {0.05, 0.01}) {
        const SignalTablePlan plan =
            zonal::plan_signal_tables<float>(kOrder, signal, {.budget = budget, .subtexel_bits = 6});
        double sum = 0;
        for (int l = 2; l < kOrder; ++l) {
            double peak = 0;
            for (const Vector3d& w : directions(500)) {
                const auto [r, g, b] = exact_sample(kOrder, l, signal, w);
                peak = std::max(peak, std::hypot(r, g, b));
            }
            const double expected = largest_change(kOrder, l) * peak *
                                    sample_bound(l, plan.size_at(plan.levels[l - 2]), 6, 0x1p-24) /
                                    norm(signal);
            const double bound = plan.band_bounds[l - 2];
            EXPECT_GE(bound, expected) << "band " << l;
            // Maxima from above instead of over some signs and directions.
            EXPECT_LE(bound, 1.6 * expected) << "band " << l;
            sum += bound * bound;
        }
        EXPECT_NEAR(plan.bound, std::sqrt(sum), 1e-6);
    }
}

/// Signal-tailored rotation as the shader does it.
template <class T>
Signal rotate_tailored(const SignalTables<T>& tables, const Signal& low, const Eigen::Matrix3f& rotation) {
    const int order = tables.plan.order;
    std::vector<float> turned(3 * (2 * order - 1));
    lobes(order, rotation.data(), turned.data());  // column-major: the inverse
    Signal samples(order * order), out(order * order);
    for (int l = 2; l < order; ++l) {
        for (int d = 0; d <= 2 * l; ++d) {
            const Vector3d w(turned[3 * d], turned[3 * d + 1], turned[3 * d + 2]);
            const auto [r, g, b] = Sampler{8}(tables, l - 2, w);
            samples[l * l + d] = Rgb<double>{r, g, b}.cast<float>();
        }
    }
    resample(order, samples.data(), out.data());
    out[0] = low[0];
    const std::array<int, 3> axis_of{1, 2, 0};
    for (int i = 0; i < 3; ++i) {
        out[1 + i] = {};
        for (int j = 0; j < 3; ++j)
            out[1 + i] = fma(rotation(axis_of[i], axis_of[j]), low[1 + j], out[1 + i]);
    }
    return out;
}

std::vector<Eigen::Matrix3f> rotations(int count) {
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    std::vector<Eigen::Matrix3f> result{Eigen::Matrix3f::Identity()};
    while (static_cast<int>(result.size()) < count) {
        const Eigen::Quaternionf q(normal(random), normal(random), normal(random), normal(random));
        result.push_back(q.normalized().toRotationMatrix());
    }
    result.push_back(-result.back());  // a mirror
    return result;
}

zonal::oracle::Matrix3 row_major(const Eigen::Matrix3f& matrix) {
    zonal::oracle::Matrix3 result;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) result[3 * i + j] = matrix(i, j);
    return result;
}

double rotation_error(const zonal::oracle::Rotation& exact, const Eigen::Matrix3f& rotation,
                      const Signal& signal, const Signal& turned) {
    const auto before = channels(signal), after = channels(turned);
    double sum = 0;
    for (int c = 0; c < 3; ++c) {
        const auto expected = exact(row_major(rotation), before[c]);
        for (std::size_t i = 0; i < expected.size(); ++i)
            sum += std::pow(static_cast<double>(after[c][i] - expected[i]), 2);
    }
    return std::sqrt(sum) / norm(signal);
}

template <class T>
void check_rotations(int order, double budget) {
    const Signal signal = lighting(order, order);
    const auto tables = zonal::build_signal_tables<T>(order, signal, {.budget = budget});
    const SignalTablePlan& plan = tables.plan;
    EXPECT_LE(plan.bound, budget);
    EXPECT_TRUE(plan.bound > 0.9 * budget || plan.face_size == zonal::kSmallestFace)
        << "the tables are larger than they need be";
    const zonal::oracle::Rotation exact(order);
    double largest = 0;
    for (const Eigen::Matrix3f& rotation : rotations(20)) {
        const Signal turned = rotate_tailored(tables, signal, rotation);
        const double error = rotation_error(exact, rotation, signal, turned);
        const double excess =
            plan.excess * static_cast<double>(zonal::oracle::orthonormality_error(row_major(rotation)));
        EXPECT_LE(error, plan.bound + excess) << "order " << order << ", budget " << budget;
        largest = std::max(largest, error);
    }
    // The bound adds what bands lose at worst; in a rotation some of it cancels.
    EXPECT_GT(largest, plan.bound / (5 * order)) << "the bound says nothing";
}

TEST(SignalTables, whole_rotations_are_within_budget_and_bound) {
    for (const int order : {3, 4, 5, 6, 8, 10})
        if (order <= lobe_orders().back()) check_rotations<half>(order, 0.05);
    for (const int order : {3, 4, 6}) check_rotations<float>(order, 0.01);
    check_rotations<float>(4, 0.002);
}

TEST(SignalTables, bands_without_energy_cost_the_smallest_faces) {
    Signal signal = lighting(5);
    std::fill(signal.begin() + 4, signal.end(), Rgb<float>{});
    const SignalTablePlan plan = zonal::plan_signal_tables<half>(5, signal, {.budget = 1e-6});
    EXPECT_EQ(plan.face_size, zonal::kSmallestFace);
    EXPECT_EQ(plan.level_count, 1);
}

TEST(SignalTables, low_bands_take_coarser_levels_and_smaller_budgets_larger_faces) {
    const Signal signal = lighting(6);
    const SignalTablePlan coarse = zonal::plan_signal_tables<float>(6, signal, {.budget = 0.02});
    const SignalTablePlan fine = zonal::plan_signal_tables<float>(6, signal, {.budget = 0.005});
    EXPECT_GT(fine.face_size, coarse.face_size);
    EXPECT_TRUE(std::ranges::is_sorted(fine.levels, std::greater<>())) << "high bands need the finer levels";
    EXPECT_GT(fine.levels.front(), fine.levels.back());
}

template <class T>
std::string message_of(int order, const Signal& signal, const SignalTableOptions& options) {
    try {
        zonal::plan_signal_tables<T>(order, signal, options);
    } catch (const zonal::Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(SignalTables, bad_arguments_are_named_with_what_was_wanted) {
    using testing::AllOf;
    using testing::HasSubstr;
    const Signal signal = lighting(4);
    const SignalTableOptions good{.budget = 0.01};
    EXPECT_THAT(message_of<half>(2, lighting(2), good),
                HasSubstr("order: found 2, wanted an order that has lobes"));
    EXPECT_THAT(message_of<half>(5, signal, good), AllOf(HasSubstr("found 16"), HasSubstr("wanted 25")));
    EXPECT_THAT(message_of<half>(4, {}, good), HasSubstr("found 0, wanted 16"));
    EXPECT_THAT(message_of<half>(4, Signal(16), good), HasSubstr("signal: found zeros only"));
    for (const double budget : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
        EXPECT_THAT(message_of<half>(4, signal, {.budget = budget}), HasSubstr("wanted a positive number"));
    EXPECT_THAT(message_of<half>(4, signal, {.budget = 0.01, .subtexel_bits = 0}),
                HasSubstr("subTexelPrecisionBits"));
    EXPECT_THAT(message_of<half>(4, signal, {.budget = 0.01, .largest_face = 16}),
                HasSubstr("maxImageDimensionCube"));
    Signal broken = signal;
    broken[7].g = std::numeric_limits<float>::infinity();
    EXPECT_THAT(message_of<float>(4, broken, good), HasSubstr("signal, coefficient 7: found inf"));
    Signal bright = signal;
    bright[5].r = 2e5f;
    EXPECT_THAT(message_of<half>(4, bright, good), AllOf(HasSubstr("signal, band 2"), HasSubstr("65504")));
    EXPECT_EQ(message_of<float>(4, bright, good), "no error");
}

TEST(SignalTables, the_least_budget_that_a_message_names_is_accepted) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
        const Signal signal = lighting(4, seed);
        const auto asked = [&](auto zero, int largest_face) {
            using T = decltype(zero);
            const std::string message =
                message_of<T>(4, signal, {.budget = 1e-9, .largest_face = largest_face});
            const std::string words = "wanted at least ";
            ASSERT_THAT(message, testing::HasSubstr(words));
            const double least = std::stod(message.substr(message.find(words) + words.size()));
            EXPECT_EQ(message_of<T>(4, signal, {.budget = least, .largest_face = largest_face}), "no error")
                << message;
        };
        asked(half(), 4096);
        asked(0.0f, 256);
        asked(0.0f, 1000);
    }
}

TEST(SignalTables, a_budget_out_of_reach_is_named_with_the_one_that_can_be_kept) {
    using testing::AllOf;
    using testing::HasSubstr;
    const Signal signal = lighting(4);
    EXPECT_THAT(message_of<half>(4, signal, {.budget = 1e-4}),
                AllOf(HasSubstr("half texels of any number keep"), HasSubstr("take float texels")));
    EXPECT_EQ(message_of<float>(4, signal, {.budget = 1e-4}), "no error");
    EXPECT_THAT(
        message_of<float>(4, signal, {.budget = 1e-4, .largest_face = 256}),
        AllOf(HasSubstr("what faces of 256 texels"), HasSubstr("raise the budget or the largest face")));
    EXPECT_THAT(message_of<float>(4, signal, {.budget = 1e-7}), HasSubstr("float texels of any number keep"));
}

}  // namespace
