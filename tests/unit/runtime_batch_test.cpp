#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "batch/targets.hpp"
#include "support/oracle.hpp"
#include "zonal/basis.hpp"
#include "zonal/batch.hpp"
#include "zonal/error.hpp"
#include "zonal/parallel.hpp"
#include "zonal/rotate.hpp"

namespace {

using zonal::BatchLayout;
using zonal::ChannelArrangement;
using zonal::RotationMatrix;

/// Stands in every value that is not of a vector; no result has these bits.
template <class T>
constexpr T kGuard = T(-12345.5);

/// Two results, each within the kernels' own bound (below N^2 epsilon) of the truth, relative to the norm of
/// the vector. A quaternion becomes a matrix with errors of at most 4 epsilon in each value, 12 in the norm,
/// which N-1 times over turn up in the result.
template <class T>
double tolerance(int order, bool from_quaternion) {
    const double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
    return (2.0 * order * order + (from_quaternion ? 12.0 * (order - 1) : 0.0)) * epsilon;
}

enum class Form { matrices, quaternions, one_for_all };

struct Case {
    int order = 0;
    BatchLayout layout = {};
    Form form = Form::matrices;
    bool in_place = false;
    std::size_t offset = 0;  ///< of the first vector and rotation, in values
    bool with_mirrors = false;
    std::size_t rotation_gap = 0;

    std::size_t coefficients() const {
        return static_cast<std::size_t>(order) * order - (layout.dc_apart ? 1 : 0);
    }
    std::size_t length() const { return coefficients() * layout.channels; }
    std::size_t stride() const { return layout.stride == 0 ? length() : layout.stride; }
    std::size_t extent() const { return layout.count == 0 ? 0 : (layout.count - 1) * stride() + length(); }
    std::size_t index(std::size_t vector, std::size_t channel, std::size_t coefficient) const {
        const bool interleaved = layout.arrangement == ChannelArrangement::interleaved;
        return vector * stride() + (interleaved ? coefficient * layout.channels + channel
                                                : channel * coefficients() + coefficient);
    }
};

template <class T>
std::vector<T> random_values(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<double> normal;
    std::vector<T> values(count);
    for (T& value : values) value = static_cast<T>(normal(random));
    return values;
}

template <class T>
Eigen::Quaternion<T> random_quaternion(std::mt19937& random) {
    std::normal_distribution<double> normal;
    return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
        .normalized()
        .template cast<T>();
}

template <class T>
class Batch {
  public:
    explicit Batch(const Case& description) : c(description) {
        std::mt19937 random(7);
        const std::size_t rotations = c.form == Form::one_for_all ? 1 : c.layout.count;
        rotation_stride = (c.form == Form::quaternions ? 4 : 9) + c.rotation_gap;
        rotation_values.assign(c.offset + (rotations + 1) * rotation_stride, kGuard<T>);
        for (std::size_t k = 0; k < rotations; ++k) {
            const Eigen::Quaternion<T> q = random_quaternion<T>(random);
            Eigen::Matrix3d matrix = q.template cast<double>().toRotationMatrix();
            if (c.with_mirrors && k % 3 != 1) matrix = -matrix;
            matrices.push_back(RotationMatrix<T>(matrix));
            T* place = rotation_values.data() + c.offset + k * rotation_stride;
            if (c.form == Form::quaternions)
                std::copy_n(q.coeffs().data(), 4, place);
            else
                std::copy_n(matrices.back().data(), 9, place);
        }
        const std::size_t margin = 64;
        in.assign(c.offset + c.extent() + margin, kGuard<T>);
        const std::vector<T> values = random_values<T>(c.length() * c.layout.count, 11);
        for (std::size_t k = 0; k < c.layout.count; ++k)
            std::copy_n(values.data() + k * c.length(), c.length(), in.data() + c.offset + k * c.stride());
        out.assign(in.size(), kGuard<T>);
    }

    void rotate(const zonal::Executor& executor = {}) {
        const std::span<const T> from = std::span<const T>(in).subspan(c.offset, c.extent());
        if (c.in_place) out = in;
        const std::span<T> to = std::span<T>(out).subspan(c.offset, c.extent());
        const std::span<const T> source = c.in_place ? std::span<const T>(to) : from;
        const std::span<const T> given = std::span<const T>(rotation_values).subspan(c.offset);
        if (c.form == Form::matrices)
            zonal::rotate_each(c.order, zonal::RotationMatrices<T>(given, rotation_stride), c.layout, source,
                               to, executor);
        else if (c.form == Form::quaternions)
            zonal::rotate_each(c.order, zonal::RotationQuaternions<T>(given, rotation_stride), c.layout,
                               source, to, executor);
        else
            zonal::rotate_all(c.order, matrices.front(), c.layout, source, to, executor);
    }

    /// One channel of one vector of `values`, all N^2 coefficients; band 0 is 1 where it is apart.
    std::vector<T> vector(const std::vector<T>& values, std::size_t k, std::size_t channel) const {
        std::vector<T> f;
        if (c.layout.dc_apart) f.push_back(1);
        for (std::size_t i = 0; i < c.coefficients(); ++i)
            f.push_back(values[c.offset + c.index(k, channel, i)]);
        return f;
    }

    const RotationMatrix<T>& matrix(std::size_t k) const {
        return matrices[c.form == Form::one_for_all ? 0 : k];
    }

    void expect_vector_turned(std::size_t k, std::size_t channel) const {
        const std::vector<T> f = vector(in, k, channel);
        std::vector<T> wanted(f.size());
        zonal::rotate(c.order, matrix(k), f, wanted);
        std::vector<T> found = vector(out, k, channel);
        double error = 0, norm = 0;
        for (std::size_t i = 0; i < f.size(); ++i) {
            error += std::pow(static_cast<double>(found[i]) - static_cast<double>(wanted[i]), 2);
            norm += std::pow(static_cast<double>(f[i]), 2);
        }
        EXPECT_LE(std::sqrt(error / norm), tolerance<T>(c.order, c.form == Form::quaternions))
            << "vector " << k << ", channel " << channel;
    }

    void expect_all_turned() const {
        for (std::size_t k = 0; k < c.layout.count; ++k)
            for (std::size_t channel = 0; channel < static_cast<std::size_t>(c.layout.channels); ++channel)
                expect_vector_turned(k, channel);
        expect_guards_untouched();
    }

    void expect_guards_untouched() const {
        std::vector<bool> is_ours(out.size(), false);
        for (std::size_t k = 0; k < c.layout.count; ++k)
            for (std::size_t i = 0; i < c.length(); ++i) is_ours[c.offset + k * c.stride() + i] = true;
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (!is_ours[i]) {
                ASSERT_EQ(out[i], kGuard<T>) << "value " << i;
            }
        }
    }

    Case c;
    std::size_t rotation_stride = 9;
    std::vector<T> rotation_values;
    std::vector<RotationMatrix<T>> matrices;
    std::vector<T> in, out;
};

template <class T>
void expect_turned(const Case& c) {
    SCOPED_TRACE(testing::Message() << "order " << c.order << ", count " << c.layout.count << ", stride "
                                    << c.stride() << ", channels " << c.layout.channels
                                    << (c.layout.arrangement == ChannelArrangement::interleaved
                                            ? " interleaved"
                                            : " channel-major")
                                    << (c.layout.dc_apart ? ", dc apart" : "") << ", form "
                                    << static_cast<int>(c.form) << (c.in_place ? ", in place" : "")
                                    << ", offset " << c.offset << (c.with_mirrors ? ", mirrors" : ""));
    Batch<T> batch(c);
    batch.rotate();
    batch.expect_all_turned();
}

std::string message_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const zonal::Error& error) {
        return error.what();
    }
    return "no error";
}

constexpr Form kForms[] = {Form::matrices, Form::quaternions, Form::one_for_all};

/// Every case runs on every instruction set that this processor has.
template <class T>
class runtime_batch : public testing::Test {
  protected:
    template <class Body>
    void on_every_target_and_order(const Body& body) {
        for (const std::string_view target : zonal::batch::runnable_targets()) {
            ASSERT_TRUE(zonal::batch::choose_target(target));
            SCOPED_TRACE(target);
            for (const int order : zonal::compiled_orders()) body(order);
        }
    }
    void TearDown() override {
        zonal::batch::choose_target("");
        zonal::batch::set_streamed_bytes(zonal::batch::kStreamedBytes);
    }
};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(runtime_batch, Scalars);

TYPED_TEST(runtime_batch, every_count_matches_single_rotations) {
    this->on_every_target_and_order([](int order) {
        for (const std::size_t count : {0, 1, 2, 3, 4, 5, 7, 8, 9, 15, 16, 17, 100})
            for (const Form form : kForms)
                expect_turned<TypeParam>({.order = order, .layout = {.count = count}, .form = form});
    });
}

TYPED_TEST(runtime_batch, in_place_matches_single_rotations) {
    this->on_every_target_and_order([](int order) {
        for (const std::size_t count : {1, 8, 17, 33})
            for (const Form form : kForms)
                expect_turned<TypeParam>(
                    {.order = order, .layout = {.count = count}, .form = form, .in_place = true});
    });
}

TYPED_TEST(runtime_batch, gaps_and_odd_addresses_match_single_rotations_and_are_left_alone) {
    this->on_every_target_and_order([](int order) {
        const auto length = static_cast<std::size_t>(order) * order;
        for (const std::size_t gap : {1, 7})
            for (const Form form : kForms)
                for (const bool in_place : {false, true})
                    expect_turned<TypeParam>({.order = order,
                                              .layout = {.count = 37, .stride = length + gap},
                                              .form = form,
                                              .in_place = in_place,
                                              .offset = 1,
                                              .rotation_gap = gap});
    });
}

TYPED_TEST(runtime_batch, channels_turn_alike_in_every_arrangement) {
    this->on_every_target_and_order([](int order) {
        for (const auto arrangement : {ChannelArrangement::interleaved, ChannelArrangement::channel_major})
            for (const int channels : {1, 2, 3, 4, 5})
                for (const bool dc_apart : {false, true})
                    for (const Form form : kForms)
                        expect_turned<TypeParam>({.order = order,
                                                  .layout = {.count = 35,
                                                             .channels = channels,
                                                             .arrangement = arrangement,
                                                             .dc_apart = dc_apart},
                                                  .form = form,
                                                  .in_place = channels == 3});
    });
}

TYPED_TEST(runtime_batch, mirrors_among_rotations_match_single_rotations) {
    this->on_every_target_and_order([](int order) {
        for (const Form form : {Form::matrices, Form::one_for_all})
            for (const int channels : {1, 3})
                expect_turned<TypeParam>({.order = order,
                                          .layout = {.count = 21, .channels = channels},
                                          .form = form,
                                          .with_mirrors = true});
    });
}

TYPED_TEST(runtime_batch, mirror_matches_pointwise_oracle) {
    using zonal::oracle::Real;
    this->on_every_target_and_order([](int order) {
        Batch<TypeParam> batch({.order = order, .layout = {.count = 18}, .with_mirrors = true});
        batch.rotate();
        const zonal::oracle::Rotation exact(order);
        for (const std::size_t k : {0, 1, 17}) {
            const std::vector<TypeParam> f = batch.vector(batch.in, k, 0);
            const std::vector<TypeParam> found = batch.vector(batch.out, k, 0);
            zonal::oracle::Matrix3 matrix;
            std::copy_n(batch.matrix(k).data(), 9, matrix.begin());
            const std::vector<Real> wanted = exact(matrix, {f.begin(), f.end()});
            Real error = 0, norm = 0;
            for (std::size_t i = 0; i < f.size(); ++i) {
                error += (found[i] - wanted[i]) * (found[i] - wanted[i]);
                norm += static_cast<Real>(f[i]) * f[i];
            }
            // R itself lacks at most (N-1)/2 times its orthonormality error, below 2 epsilon.
            EXPECT_LE(static_cast<double>(std::sqrt(error / norm)), tolerance<TypeParam>(order, false))
                << "order " << order << ", vector " << k;
        }
    });
}

TYPED_TEST(runtime_batch, nan_stays_within_its_vector_and_band) {
    struct Place {
        std::size_t count, gap, vector;
    };
    this->on_every_target_and_order([](int order) {
        const auto last = static_cast<std::size_t>(order - 1);
        for (const auto& [count, gap, bad] :
             {Place{16, 0, 1}, Place{16, 1, 15}, Place{19, 0, 1}, Place{19, 0, 18}})
            for (const std::size_t band : {std::size_t{0}, last}) {
                SCOPED_TRACE(testing::Message() << "order " << order << ", vector " << bad << " of " << count
                                                << ", gap " << gap << ", band " << band);
                Batch<TypeParam> batch({.order = order,
                                        .layout = {.count = count, .stride = (last + 1) * (last + 1) + gap},
                                        .with_mirrors = true});
                batch.in[batch.c.index(bad, 0, band * band)] = std::numeric_limits<TypeParam>::quiet_NaN();
                batch.rotate();
                for (std::size_t k = 0; k < count; ++k)
                    if (k != bad) batch.expect_vector_turned(k, 0);
                const std::vector<TypeParam> f = batch.vector(batch.out, bad, 0);
                const auto begin = f.begin() + band * band, end = f.begin() + (band + 1) * (band + 1);
                const auto is_finite = [](auto v) { return std::isfinite(v); };
                EXPECT_TRUE(std::any_of(begin, end, [](auto v) { return std::isnan(v); }));
                EXPECT_TRUE(std::all_of(f.begin(), begin, is_finite) && std::all_of(end, f.end(), is_finite));
            }
    });
}

TYPED_TEST(runtime_batch, nan_in_a_rotation_spoils_its_vector_only) {
    this->on_every_target_and_order([](int order) {
        for (const std::size_t bad : {2, 18}) {
            SCOPED_TRACE(testing::Message() << "order " << order << ", vector " << bad);
            Batch<TypeParam> batch({.order = order, .layout = {.count = 19}, .with_mirrors = true});
            for (std::size_t i = 0; i < 9; ++i)
                batch.rotation_values[9 * bad + i] = std::numeric_limits<TypeParam>::quiet_NaN();
            batch.rotate();
            for (std::size_t k = 0; k < 19; ++k)
                if (k != bad) batch.expect_vector_turned(k, 0);
            if (order > 1) {
                EXPECT_TRUE(std::isnan(batch.out[batch.c.index(bad, 0, 1)]));
            }
        }
    });
}

TYPED_TEST(runtime_batch, layouts_larger_than_the_caches_match_single_rotations) {
    zonal::batch::set_streamed_bytes(0);
    this->on_every_target_and_order([](int order) {
        for (const auto arrangement : {ChannelArrangement::interleaved, ChannelArrangement::channel_major})
            for (const int channels : {1, 3, 5})
                for (const bool dc_apart : {false, true})
                    for (const bool in_place : {false, true})
                        expect_turned<TypeParam>({.order = order,
                                                  .layout = {.count = 83,
                                                             .channels = channels,
                                                             .arrangement = arrangement,
                                                             .dc_apart = dc_apart},
                                                  .form = channels == 1 ? Form::matrices : Form::one_for_all,
                                                  .in_place = in_place,
                                                  .offset = 3});
    });
}

TYPED_TEST(runtime_batch, long_runs_at_any_address_match_single_rotations) {
    using T = TypeParam;
    const std::size_t count = 20005;
    zonal::batch::set_streamed_bytes(1 << 16);
    for (const std::string_view target : zonal::batch::runnable_targets()) {
        ASSERT_TRUE(zonal::batch::choose_target(target));
        for (const int order : zonal::compiled_orders().first(2)) {
            for (const std::size_t offset : {0, 1, 5}) {
                for (const Form form : {Form::matrices, Form::one_for_all}) {
                    SCOPED_TRACE(testing::Message()
                                 << target << ", order " << order << ", offset " << offset);
                    Batch<T> batch(
                        {.order = order, .layout = {.count = count}, .form = form, .offset = offset});
                    batch.rotate();
                    for (std::size_t k = 0; k < count; k += k < 2000 || k + 200 > count ? 1 : 97)
                        batch.expect_vector_turned(k, 0);
                    batch.expect_guards_untouched();
                }
            }
        }
    }
}

TYPED_TEST(runtime_batch, ranges_in_any_order_and_on_any_thread_give_the_same_bits) {
    const zonal::Executor backwards = [](std::size_t count, const auto& body) {
        for (std::size_t end = count; end > 0; end -= std::min<std::size_t>(end, 37))
            body(end - std::min<std::size_t>(end, 37), end);
    };
    this->on_every_target_and_order([&](int order) {
        for (const std::size_t streamed_bytes : {std::size_t{0}, zonal::batch::kStreamedBytes}) {
            zonal::batch::set_streamed_bytes(streamed_bytes);
            for (const Form form : kForms) {
                Batch<TypeParam> whole({.order = order, .layout = {.count = 150}, .form = form, .offset = 1});
                whole.rotate();
                for (const zonal::Executor& executor : {backwards, zonal::on_all_cores(16)}) {
                    Batch<TypeParam> parts(whole.c);
                    parts.rotate(executor);
                    EXPECT_EQ(parts.out, whole.out) << "order " << order;
                }
            }
        }
    });
}

TYPED_TEST(runtime_batch, vectors_and_rotations_may_be_members_of_one_struct) {
    using T = TypeParam;
    this->on_every_target_and_order([](int order) {
        const auto n = static_cast<std::size_t>(order) * order;
        const std::size_t stride = 9 + 2 * n, count = 20;
        const Batch<T> apart({.order = order, .layout = {.count = count}});
        std::vector<T> records(count * stride);
        for (std::size_t k = 0; k < count; ++k) {
            std::copy_n(apart.matrices[k].data(), 9, records.data() + k * stride);
            std::copy_n(apart.in.data() + k * n, n, records.data() + k * stride + 9);
        }
        const std::span<T> all(records);
        zonal::rotate_each(order, zonal::RotationMatrices<T>(all, stride), {.count = count, .stride = stride},
                           all.subspan(9), all.subspan(9 + n));
        Batch<T> wanted = apart;
        wanted.rotate();
        for (std::size_t k = 0; k < count; ++k)
            for (std::size_t i = 0; i < n; ++i)
                ASSERT_EQ(records[k * stride + 9 + n + i], wanted.out[k * n + i]) << "vector " << k;
    });
}

TEST(runtime_batch_door, matrices_are_taken_as_they_are) {
    const std::vector<RotationMatrix<float>> rotations(5);
    const zonal::RotationMatrices<float> matrices{std::span<const RotationMatrix<float>>(rotations)};
    EXPECT_EQ(matrices.values.data(), rotations.front().data());
    EXPECT_EQ(matrices.values.size(), 45U);
}

class runtime_batch_errors : public testing::Test {
  protected:
    const int order = zonal::compiled_orders().front();
    const std::size_t n = static_cast<std::size_t>(order) * order;
    std::vector<float> in = std::vector<float>(10 * n, 7.0F);
    std::vector<float> out = in;
    std::vector<float> rotations = std::vector<float>(90);

    std::string each(int at_order, const BatchLayout& layout, std::span<const float> from,
                     std::span<float> to) {
        const std::vector<float> before(to.begin(), to.end());
        const std::string message = message_of([&] {
            zonal::rotate_each(at_order, zonal::RotationMatrices<float>(rotations), layout, from, to);
        });
        EXPECT_TRUE(std::equal(before.begin(), before.end(), to.begin()));
        return message;
    }
};

TEST_F(runtime_batch_errors, order_that_is_not_compiled_is_named) {
    EXPECT_NE(each(21, {.count = 1}, in, out).find("order: found 21"), std::string::npos);
}

TEST_F(runtime_batch_errors, spans_too_short_are_named_with_both_lengths) {
    const std::string wanted = "found " + std::to_string(10 * n) + ", wanted " + std::to_string(11 * n);
    rotations.resize(99);
    EXPECT_NE(each(order, {.count = 11}, in, out).find("length of in: " + wanted), std::string::npos);
    in.resize(11 * n);
    EXPECT_NE(each(order, {.count = 11}, in, out).find("length of out: " + wanted), std::string::npos);
    out.resize(11 * n);
    rotations.resize(98);
    EXPECT_NE(each(order, {.count = 11}, in, out).find("length of rotations: found 98, wanted 99"),
              std::string::npos);
}

TEST_F(runtime_batch_errors, count_too_large_for_memory_is_refused) {
    rotations.resize(9);
    EXPECT_NE(each(order, {.count = std::numeric_limits<std::size_t>::max()}, in, out).find("length of"),
              std::string::npos);
}

TEST_F(runtime_batch_errors, stride_shorter_than_a_vector_is_refused) {
    EXPECT_NE(each(order, {.count = 2, .stride = n - 1}, in, out).find("stride of in: found"),
              std::string::npos);
}

TEST_F(runtime_batch_errors, no_channels_are_refused) {
    EXPECT_NE(each(order, {.count = 2, .channels = 0}, in, out).find("layout.channels: found 0"),
              std::string::npos);
}

TEST_F(runtime_batch_errors, partial_overlap_is_refused) {
    const std::span<float> all(in);
    EXPECT_NE(each(order, {.count = 5}, all.subspan(1), all).find("in and out: found arrays that overlap"),
              std::string::npos);
    EXPECT_NE(each(order, {.count = 5}, all, all.subspan(n)).find("in and out: found arrays that overlap"),
              std::string::npos);
}

TEST_F(runtime_batch_errors, output_over_the_rotations_is_refused) {
    rotations.resize(9 + 10 * n);
    EXPECT_NE(each(order, {.count = 1}, in, std::span<float>(rotations).subspan(8)).find("rotations and out"),
              std::string::npos);
}

}  // namespace
