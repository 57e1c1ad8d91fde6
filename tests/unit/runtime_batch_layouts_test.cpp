// Batches in every layout, judged by single calls: where values lie, in what convention, and how calls that
// contradict themselves are refused.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "batch/targets.hpp"
#include "zonal/batch.hpp"
#include "zonal/eigen.hpp"
#include "zonal/error.hpp"
#include "zonal/parallel.hpp"
#include "zonal/rotate.hpp"

namespace {

using testing::HasSubstr;
using zonal::BatchLayout;
using zonal::ChannelArrangement;
using zonal::Convention;
using zonal::PlanarLayout;
using zonal::RotationMatrix;

enum class Form { matrices, xyzw, wxyz, one_for_all };
constexpr Form kForms[] = {Form::matrices, Form::xyzw, Form::wxyz, Form::one_for_all};

/// Two results, each within the kernels' own bound (below N^2 epsilon) of the truth, relative to the norm of
/// the vector; a quaternion becomes a matrix with errors of at most 12 epsilon in the norm, which N-1 times
/// over turn up in the result; and a convention's scales cost each result 3/2 epsilon twice.
template <class T>
double tolerance(int order, bool from_quaternion) {
    const double epsilon = static_cast<double>(std::numeric_limits<T>::epsilon());
    return (2.0 * order * order + (from_quaternion ? 12.0 * (order - 1) : 0.0) + 6) * epsilon;
}

/// Stands in every value that is not of a vector; no result has these bits.
template <class T>
constexpr T kGuard = T(-12345.5);

/// Where value i of one channel of vector k lies, i counted from 1 where band 0 is apart.
using Index = std::function<std::size_t(std::size_t k, std::size_t channel, std::size_t i)>;

struct Signals {
    int order;
    std::size_t count;
    std::size_t channels = 1;
    bool dc_apart = false;
    std::optional<Convention> convention = {};

    std::size_t first() const { return dc_apart ? 1 : 0; }
    std::size_t coefficients() const { return static_cast<std::size_t>(order) * order; }
    std::size_t length() const { return channels * (coefficients() - first()); }
};

/// Rotations and vectors of a batch, and what single calls make of them.
template <class T>
class Batch {
  public:
    Batch(const Signals& signals, Form form) : s(signals), form_(form) {
        std::mt19937 random(5);
        std::normal_distribution<double> normal;
        for (std::size_t k = 0; k < (form == Form::one_for_all ? 1 : s.count); ++k) {
            const Eigen::Quaternion<T> q =
                Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random))
                    .normalized()
                    .template cast<T>();
            RotationMatrix<T> R(q);
            if (s.convention == Convention::kDirectX && form != Form::matrices && form != Form::one_for_all)
                columns_.push_back(RotationMatrix<T>(Eigen::Matrix<T, 3, 3>(R.matrix().transpose())));
            else
                columns_.push_back(R);
            if (form == Form::xyzw)
                rotations.insert(rotations.end(), {q.x(), q.y(), q.z(), q.w()});
            else if (form == Form::wxyz)
                rotations.insert(rotations.end(), {q.w(), q.x(), q.y(), q.z()});
            else
                rotations.insert(rotations.end(), R.data(), R.data() + 9);
        }
    }

    /// `size` values with vectors at `index` and guards elsewhere.
    std::vector<T> laid_out(std::size_t size, const Index& index) const {
        std::vector<T> values(size, kGuard<T>);
        std::mt19937 random(6);
        std::normal_distribution<double> normal;
        for (std::size_t k = 0; k < s.count; ++k)
            for (std::size_t channel = 0; channel < s.channels; ++channel)
                for (std::size_t i = s.first(); i < s.coefficients(); ++i)
                    values.at(index(k, channel, i)) = static_cast<T>(normal(random));
        return values;
    }

    /// Calls body(rotations) with what rotate_each takes; not for one rotation.
    template <class Body>
    void with_rotations(const Body& body) const {
        if (form_ == Form::matrices)
            body(zonal::RotationMatrices<T>(rotations));
        else if (form_ == Form::xyzw)
            body(zonal::RotationQuaternions<T>::xyzw(rotations));
        else
            body(zonal::RotationQuaternions<T>::wxyz(rotations));
    }

    /// Calls rotate_each or rotate_all with the other arguments.
    template <class... Arguments>
    void rotate(const Arguments&... arguments) const {
        if (form_ == Form::one_for_all)
            zonal::rotate_all(s.order, columns_.front(), arguments...);
        else
            with_rotations([&](const auto& given) { zonal::rotate_each(s.order, given, arguments...); });
    }

    void expect_turned(const std::vector<T>& in, const Index& in_index, const std::vector<T>& out,
                       const Index& out_index) const {
        std::vector<bool> is_ours(out.size(), false);
        for (std::size_t k = 0; k < s.count; ++k) {
            for (std::size_t channel = 0; channel < s.channels; ++channel) {
                std::vector<T> f(s.coefficients(), T(1)), found = f, wanted(f.size());
                for (std::size_t i = s.first(); i < f.size(); ++i) {
                    f[i] = in[in_index(k, channel, i)];
                    found[i] = out[out_index(k, channel, i)];
                    is_ours[out_index(k, channel, i)] = true;
                }
                const RotationMatrix<T>& R = columns_[form_ == Form::one_for_all ? 0 : k];
                if (s.convention) {
                    zonal::rotate(*s.convention, s.order, R, std::span<const T>(f), std::span<T>(wanted));
                    for (std::vector<T>* values : {&f, &found, &wanted})
                        zonal::to_zonal(*s.convention, s.order, std::span<const T>(*values),
                                        std::span<T>(*values));
                } else {
                    zonal::rotate(s.order, R, f, wanted);
                }
                double error = 0, norm = 0;
                for (std::size_t i = s.first(); i < f.size(); ++i) {
                    error += std::pow(static_cast<double>(found[i]) - static_cast<double>(wanted[i]), 2);
                    norm += std::pow(static_cast<double>(f[i]), 2);
                }
                const bool from_quaternion = form_ == Form::xyzw || form_ == Form::wxyz;
                // Band 0 apart leaves nothing else of order 1; e3nn turns the polar axis twice more.
                const double bound =
                    (s.convention == Convention::kE3nn ? 3 : 1) * tolerance<T>(s.order, from_quaternion);
                ASSERT_LE(std::sqrt(error / norm), bound) << "vector " << k << ", channel " << channel;
            }
        }
        for (std::size_t i = 0; i < out.size(); ++i) {
            if (!is_ours[i]) {
                ASSERT_EQ(out[i], kGuard<T>) << "value " << i;
            }
        }
    }

    Signals s;
    std::vector<T> rotations;

  private:
    Form form_;
    std::vector<RotationMatrix<T>> columns_;
};

/// A batch in rows, in place or into another array, from one stride to another.
template <class T>
void expect_rows_turned(const Signals& s, Form form, ChannelArrangement arrangement, bool in_place,
                        std::size_t gap = 0, std::size_t out_gap = 0) {
    const std::size_t stride = s.length() + gap, out_stride = s.length() + out_gap;
    SCOPED_TRACE(testing::Message() << "order " << s.order << ", count " << s.count << ", channels "
                                    << s.channels << ", form " << static_cast<int>(form) << ", dc apart "
                                    << s.dc_apart << ", in place " << in_place << ", strides " << stride
                                    << " and " << out_stride << ", channel-major "
                                    << (arrangement == ChannelArrangement::channel_major) << ", convention "
                                    << (s.convention ? static_cast<int>(*s.convention) : -1));
    const auto index_with = [&](std::size_t step) {
        return [&s, arrangement, step](std::size_t k, std::size_t channel, std::size_t i) {
            const std::size_t column = i - s.first();
            return k * step + (arrangement == ChannelArrangement::interleaved
                                   ? column * s.channels + channel
                                   : channel * (s.coefficients() - s.first()) + column);
        };
    };
    const Batch<T> batch(s, form);
    const Index in_index = index_with(stride), out_index = index_with(out_stride);
    const std::vector<T> in = batch.laid_out(s.count * stride, in_index);
    std::vector<T> out(s.count * out_stride, kGuard<T>);
    if (in_place) out = in;
    const BatchLayout layout{.count = s.count,
                             .stride = stride,
                             .channels = static_cast<int>(s.channels),
                             .arrangement = arrangement,
                             .dc_apart = s.dc_apart,
                             .out_stride = out_stride,
                             .convention = s.convention};
    batch.rotate(layout, std::span<const T>(in_place ? out : in), std::span<T>(out));
    batch.expect_turned(in, in_index, out, out_index);
}

/// A planar batch, from planes that are given by pointers or by their distance.
template <class T>
void expect_planes_turned(const Signals& s, Form form, bool by_pointers, bool in_place, std::size_t gap = 0,
                          std::size_t out_gap = 0, const zonal::Executor& executor = {}) {
    SCOPED_TRACE(testing::Message() << "order " << s.order << ", count " << s.count << ", channels "
                                    << s.channels << ", form " << static_cast<int>(form) << ", dc apart "
                                    << s.dc_apart << ", in place " << in_place << ", pointers " << by_pointers
                                    << ", gaps " << gap << " and " << out_gap);
    const std::size_t planes = s.coefficients() - s.first();
    const auto plane_of = [&](std::size_t step) { return s.count * step + 3; };
    const auto index_with = [&](std::size_t step) {
        return [&s, step, plane = plane_of(step)](std::size_t k, std::size_t channel, std::size_t i) {
            return (i - s.first()) * plane + k * step + channel;
        };
    };
    const std::size_t step = s.channels + gap, out_step = s.channels + out_gap;
    const Batch<T> batch(s, form);
    const Index in_index = index_with(step), out_index = index_with(out_step);
    const std::vector<T> in = batch.laid_out(planes * plane_of(step), in_index);
    std::vector<T> out(planes * plane_of(out_step), kGuard<T>);
    if (in_place) out = in;
    const T* const from = in_place ? out.data() : in.data();
    std::vector<const T*> in_pointers;
    std::vector<T*> out_pointers;
    for (std::size_t i = 0; i < planes; ++i) {
        in_pointers.push_back(from + i * plane_of(step));
        out_pointers.push_back(out.data() + i * plane_of(out_step));
    }
    const zonal::Planes<const T> given =
        by_pointers ? zonal::Planes<const T>(in_pointers)
                    : zonal::Planes<const T>(std::span<const T>(from, in.size()), plane_of(step));
    const zonal::Planes<T> room =
        by_pointers ? zonal::Planes<T>(out_pointers) : zonal::Planes<T>(out, plane_of(out_step));
    const PlanarLayout layout{.count = s.count,
                              .channels = static_cast<int>(s.channels),
                              .dc_apart = s.dc_apart,
                              .stride = step,
                              .out_stride = out_step,
                              .convention = s.convention};
    batch.rotate(layout, given, room, executor);
    batch.expect_turned(in, in_index, out, out_index);
}

template <class T>
class runtime_batch_layouts : public testing::Test {
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
TYPED_TEST_SUITE(runtime_batch_layouts, Scalars);

TYPED_TEST(runtime_batch_layouts, any_number_of_interleaved_channels) {
    this->on_every_target_and_order([](int order) {
        for (const std::size_t channels : {2, 4, 5, 6, 7, 8, 9, 11, 15, 16, 17, 20, 31, 33, 64, 67})
            for (const std::size_t count : {2, 19})
                for (const Form form : {Form::matrices, Form::one_for_all})
                    expect_rows_turned<TypeParam>(
                        {.order = order, .count = count, .channels = channels, .dc_apart = channels % 3 == 0},
                        form, ChannelArrangement::interleaved, channels % 2 == 0, channels % 5, channels % 5);
    });
}

TYPED_TEST(runtime_batch_layouts, one_vector_of_hundreds_of_channels) {
    this->on_every_target_and_order([](int order) {
        for (const std::size_t channels : {130, 512})
            for (const Form form : kForms)
                for (const bool in_place : {false, true})
                    expect_rows_turned<TypeParam>({.order = order, .count = 1, .channels = channels}, form,
                                                  ChannelArrangement::interleaved, in_place);
    });
}

TYPED_TEST(runtime_batch_layouts, an_output_stride_of_its_own) {
    this->on_every_target_and_order([](int order) {
        for (const auto arrangement : {ChannelArrangement::interleaved, ChannelArrangement::channel_major})
            for (const std::size_t channels : {1, 3, 5})
                for (const Form form : {Form::wxyz, Form::one_for_all})
                    for (const bool is_wider : {false, true})
                        expect_rows_turned<TypeParam>(
                            {.order = order, .count = 37, .channels = channels, .dc_apart = channels == 5},
                            form, arrangement, false, is_wider ? 0 : 4, is_wider ? 3 : 0);
    });
}

TYPED_TEST(runtime_batch_layouts, planes) {
    this->on_every_target_and_order([](int order) {
        for (const std::size_t count : {0, 1, 3, 16, 17, 33, 64, 95})
            for (const Form form : kForms)
                for (const bool in_place : {false, true})
                    expect_planes_turned<TypeParam>(
                        {.order = order, .count = count, .dc_apart = count % 3 == 0}, form,
                        in_place != (count % 2 == 0), in_place);
    });
}

TYPED_TEST(runtime_batch_layouts, planes_of_colours_and_with_gaps) {
    this->on_every_target_and_order([](int order) {
        for (const std::size_t channels : {1, 3})
            for (const std::size_t gap : {0, 5})
                for (const Form form : {Form::matrices, Form::one_for_all})
                    for (const bool in_place : {false, true})
                        expect_planes_turned<TypeParam>({.order = order, .count = 35, .channels = channels},
                                                        form, true, in_place, gap, in_place ? gap : 2);
    });
}

TYPED_TEST(runtime_batch_layouts, every_convention) {
    using T = TypeParam;
    const auto has_order = [](Convention convention, int order) {
        try {
            const std::vector<float> zeros(static_cast<std::size_t>(order) * order);
            std::vector<float> out(zeros.size());
            zonal::to_zonal(convention, order, std::span<const float>(zeros), std::span<float>(out));
        } catch (const zonal::Error&) {
            return false;
        }
        return true;
    };
    this->on_every_target_and_order([&](int order) {
        for (int number = 0; number <= static_cast<int>(Convention::kE3nn); ++number) {
            const auto convention = static_cast<Convention>(number);
            if (!has_order(convention, order)) continue;
            for (const Form form : kForms) {
                for (const std::size_t count : {3, 35}) {
                    expect_rows_turned<T>({order, count, 1, false, convention}, form,
                                          ChannelArrangement::interleaved, false);
                    expect_rows_turned<T>({order, count, 3, true, convention}, form,
                                          ChannelArrangement::channel_major, true);
                    expect_rows_turned<T>({order, count, 3, false, convention}, form,
                                          ChannelArrangement::interleaved, false);
                    expect_rows_turned<T>({order, count, 20, false, convention}, form,
                                          ChannelArrangement::interleaved, true);
                    expect_planes_turned<T>({order, count, 1, false, convention}, form, true, true);
                }
            }
        }
    });
}

TYPED_TEST(runtime_batch_layouts, ranges_of_an_executor_give_the_same_bits) {
    using T = TypeParam;
    const zonal::Executor in_pieces = [](std::size_t count, const auto& body) {
        for (std::size_t begin = 0; begin < count; begin += 7) body(begin, std::min(begin + 7, count));
    };
    this->on_every_target_and_order([&](int order) {
        for (const std::size_t channels : {5, 20}) {
            for (const Form form : {Form::matrices, Form::one_for_all}) {
                const Signals s{.order = order, .count = 40, .channels = channels};
                const Batch<T> batch(s, form);
                const std::vector<T> in = batch.laid_out(s.count * s.length(), [&](auto k, auto c, auto i) {
                    return k * s.length() + i * s.channels + c;
                });
                std::vector<T> whole(in.size()), parts(in.size());
                const BatchLayout layout{.count = s.count, .channels = static_cast<int>(channels)};
                batch.rotate(layout, std::span<const T>(in), std::span<T>(whole));
                batch.rotate(layout, std::span<const T>(in), std::span<T>(parts), in_pieces);
                EXPECT_EQ(parts, whole) << "order " << order << ", channels " << channels;
            }
        }
        for (const Form form : kForms) {
            const Signals s{.order = order, .count = 40};
            const Batch<T> batch(s, form);
            const std::vector<T> in =
                batch.laid_out(s.count * s.length(), [&](auto k, auto, auto i) { return i * s.count + k; });
            std::vector<T> whole(in.size()), parts(in.size());
            const zonal::Planes<const T> from(in, s.count);
            batch.rotate(PlanarLayout{.count = s.count}, from, zonal::Planes<T>(whole, s.count));
            batch.rotate(PlanarLayout{.count = s.count}, from, zonal::Planes<T>(parts, s.count), in_pieces);
            EXPECT_EQ(parts, whole) << "order " << order << ", planes, form " << static_cast<int>(form);
        }
    });
}

TYPED_TEST(runtime_batch_layouts, colours_and_vectors_of_matrices_are_taken_as_they_are) {
    using T = TypeParam;
    using Colours = std::vector<zonal::Rgb<T>>;
    for (const int order : zonal::compiled_orders()) {
        const std::size_t length = static_cast<std::size_t>(order) * order, count = 19;
        const Batch<T> batch({.order = order, .count = count, .channels = 3}, Form::matrices);
        std::vector<RotationMatrix<T>> matrices;
        for (std::size_t k = 0; k < count; ++k)
            matrices.push_back(RotationMatrix<T>::from_row_major(batch.rotations.data() + 9 * k));
        Colours in(length * count), out(in.size()), wanted(in.size());
        for (std::size_t i = 0; i < in.size(); ++i) in[i] = {T(1) + T(i % 7), T(i % 5), T(2) - T(i % 3)};
        const std::span<const zonal::Rgb<T>> given(in);
        const BatchLayout layout{.count = count, .channels = 3};
        zonal::rotate_each(order, zonal::RotationMatrices<T>(matrices), layout, zonal::values_of(given),
                           zonal::values_of(std::span(wanted)));
        zonal::rotate_each(order, zonal::RotationMatrices<T>(matrices), given, std::span(out));
        EXPECT_EQ(out, wanted);
        zonal::rotate_all(order, matrices[1], layout, zonal::values_of(given),
                          zonal::values_of(std::span(wanted)));
        zonal::rotate_all(order, matrices[1], given, std::span(out));
        EXPECT_EQ(out, wanted);
    }
}

TYPED_TEST(runtime_batch_layouts, a_quaternion_and_its_negative_are_the_same_rotation) {
    using T = TypeParam;
    this->on_every_target_and_order([](int order) {
        for (const std::size_t count : {2, 33}) {
            const Signals s{.order = order, .count = count};
            const Batch<T> batch(s, Form::wxyz);
            const std::vector<T> in =
                batch.laid_out(count * s.length(), [&](auto k, auto, auto i) { return k * s.length() + i; });
            std::vector<T> negative = batch.rotations, out(in.size()), other(in.size());
            for (T& value : negative) value = -value;
            const auto turn = [&](const std::vector<T>& quaternions, std::vector<T>& to) {
                zonal::rotate_each(order, zonal::RotationQuaternions<T>::wxyz(quaternions),
                                   BatchLayout{.count = count}, std::span<const T>(in), std::span<T>(to));
            };
            turn(batch.rotations, out);
            turn(negative, other);
            EXPECT_EQ(out, other) << "order " << order;
        }
    });
}

TYPED_TEST(runtime_batch_layouts, a_norm_off_one_costs_what_is_stated) {
    using T = TypeParam;
    const double excess = 1e-3;
    this->on_every_target_and_order([&](int order) {
        for (const std::size_t count : {2, 33}) {
            const Signals s{.order = order, .count = count};
            const Batch<T> batch(s, Form::xyzw);
            const std::vector<T> in =
                batch.laid_out(count * s.length(), [&](auto k, auto, auto i) { return k * s.length() + i; });
            std::vector<T> longer = batch.rotations, out(in.size()), wanted(in.size());
            for (T& value : longer) value = static_cast<T>((1 + excess) * static_cast<double>(value));
            const auto turn = [&](const std::vector<T>& quaternions, std::vector<T>& to) {
                zonal::rotate_each(order, zonal::RotationQuaternions<T>(quaternions),
                                   BatchLayout{.count = count}, std::span<const T>(in), std::span<T>(to));
            };
            turn(batch.rotations, wanted);
            turn(longer, out);
            double worst = 0;
            for (std::size_t k = 0; k < count; ++k) {
                double error = 0, norm = 0;
                for (std::size_t i = k * s.length(); i < (k + 1) * s.length(); ++i) {
                    error += std::pow(static_cast<double>(out[i]) - static_cast<double>(wanted[i]), 2);
                    norm += std::pow(static_cast<double>(in[i]), 2);
                }
                worst = std::max(worst, std::sqrt(error / norm));
            }
            // R R^T - I is 8 sqrt(2) e at most, to first order; the excess of every kernel is at most this.
            const double kernel_excess = std::max(2.3, 0.55 * (order - 1));
            EXPECT_LE(worst, 8 * std::sqrt(2.0) * excess * kernel_excess) << "order " << order;
            EXPECT_GT(worst, excess) << "order " << order;
        }
    });
}

TYPED_TEST(runtime_batch_layouts, nan_in_a_quaternion_spoils_its_vector_only) {
    using T = TypeParam;
    this->on_every_target_and_order([](int order) {
        for (const std::size_t count : {3, 19}) {
            for (std::size_t value = 0; value < 4; ++value) {
                const Signals s{.order = order, .count = count};
                Batch<T> batch(s, Form::xyzw);
                const std::vector<T> in = batch.laid_out(
                    count * s.length(), [&](auto k, auto, auto i) { return k * s.length() + i; });
                std::vector<T> wanted(in.size()), out(in.size());
                const BatchLayout layout{.count = count};
                batch.rotate(layout, std::span<const T>(in), std::span<T>(wanted));
                const std::size_t bad = count - 1;
                batch.rotations[4 * bad + value] = std::numeric_limits<T>::quiet_NaN();
                batch.rotate(layout, std::span<const T>(in), std::span<T>(out));
                EXPECT_TRUE(std::equal(out.begin(), out.begin() + bad * s.length(), wanted.begin()));
                EXPECT_TRUE(std::isnan(out[bad * s.length() + 1])) << "order " << order;
            }
        }
    });
}

std::string message_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const zonal::Error& error) {
        return error.what();
    }
    return "no error";
}

class runtime_batch_refusals : public testing::Test {
  protected:
    const int order = zonal::compiled_orders().front();
    const std::size_t n = static_cast<std::size_t>(order) * order;
    const RotationMatrix<float> R = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    std::vector<float> in = std::vector<float>(100 * n, 7.0F), out = in;
    std::vector<float> rotations = std::vector<float>(900, 0.0F);

    /// The message of a call, which must have left `out` as it was.
    std::string refused(const std::function<void()>& call) {
        const std::vector<float> before = out;
        const std::string message = message_of(call);
        EXPECT_EQ(out, before);
        return message;
    }
    /// Floats that begin a byte behind those of a vector.
    template <class T>
    static T* one_byte_on(T* values) {
        return reinterpret_cast<T*>(reinterpret_cast<std::uintptr_t>(values) + 1);
    }
};

TEST_F(runtime_batch_refusals, addresses_that_no_float_has) {
    for (const std::size_t count : {3, 90}) {
        const BatchLayout layout{.count = count};
        const std::size_t size = count * n;
        const std::span<const float> from(in.data(), size), odd_from(one_byte_on(in.data()), size);
        const std::span<float> to(out.data(), size), odd_to(one_byte_on(out.data()), size);
        EXPECT_THAT(refused([&] { zonal::rotate_all(order, R, layout, odd_from, to); }),
                    HasSubstr("address of in: found one that is not a multiple of 4"));
        EXPECT_THAT(refused([&] { zonal::rotate_all(order, R, layout, from, odd_to); }),
                    HasSubstr("address of out: found one that is not a multiple of 4"));
        const std::span<const float> odd(one_byte_on(rotations.data()), 9 * count);
        EXPECT_THAT(refused([&] {
                        zonal::rotate_each(order, zonal::RotationMatrices<float>(odd), layout, from, to);
                    }),
                    HasSubstr("address of rotations: found"));
        std::vector<const float*> pointers;
        for (std::size_t i = 0; i < n; ++i) pointers.push_back(in.data() + i * count);
        pointers[2] = one_byte_on(pointers[2]);
        EXPECT_THAT(refused([&] {
                        zonal::rotate_all(order, R, PlanarLayout{.count = count},
                                          zonal::Planes<const float>(pointers),
                                          zonal::Planes<float>(out, count));
                    }),
                    HasSubstr("address of plane 2 of in: found"));
    }
}

TEST_F(runtime_batch_refusals, sizes_beyond_any_memory_are_told_as_they_are) {
    constexpr std::size_t kMost = std::numeric_limits<std::size_t>::max();
    const auto message = [&](std::size_t count, std::size_t stride) {
        return refused([&] {
            zonal::rotate_all(order, R, BatchLayout{.count = count, .stride = stride},
                              std::span<const float>(in), std::span<float>(out));
        });
    };
    const std::string more = "wanted more than " + std::to_string(kMost);
    EXPECT_THAT(message(kMost, n), HasSubstr(more));
    EXPECT_THAT(message(3, kMost / 2 + 1), HasSubstr(more));  // the product wraps to 0
    EXPECT_THAT(message(kMost / n + 2, n), HasSubstr(more));  // and to little
    EXPECT_THAT(message(101, n), HasSubstr("wanted " + std::to_string(101 * n) + " for 101"));
    EXPECT_THAT(refused([&] {
                    std::vector<const float*> from(n, in.data());
                    std::vector<float*> to(n, out.data());
                    zonal::rotate_all(order, R, PlanarLayout{.count = kMost / 2},
                                      zonal::Planes<const float>(from), zonal::Planes<float>(to));
                }),
                HasSubstr("layout.count: found " + std::to_string(kMost / 2)));
}

TEST_F(runtime_batch_refusals, executors_that_hand_out_something_else) {
    const BatchLayout layout{.count = 40};
    const auto message = [&](const zonal::Executor& executor) {
        return message_of([&] {
            zonal::rotate_all(order, R, layout, std::span<const float>(in), std::span<float>(out), executor);
        });
    };
    const std::vector<float> before = out;
    EXPECT_THAT(message([](std::size_t count, const auto& body) { body(0, count + 1); }),
                HasSubstr("executor: found a range from 0 to 41"));
    EXPECT_THAT(message([](std::size_t count, const auto& body) { body(count, 1); }),
                HasSubstr("executor: found a range from 40 to 1"));
    EXPECT_THAT(message([](std::size_t, const auto&) {}), HasSubstr("executor: found ranges of 0 vectors"));
    EXPECT_EQ(out, before);
    EXPECT_THAT(message([](std::size_t count, const auto& body) { body(0, count), body(0, count); }),
                HasSubstr("executor: found ranges of 80 vectors in all, wanted 40"));
}

TEST_F(runtime_batch_refusals, planes_that_are_not_as_said) {
    const PlanarLayout layout{.count = 20};
    std::vector<const float*> from;
    std::vector<float*> to;
    for (std::size_t i = 0; i < n; ++i) from.push_back(in.data() + 20 * i), to.push_back(out.data() + 20 * i);
    const auto message = [&] {
        return refused([&] {
            zonal::rotate_all(order, R, layout, zonal::Planes<const float>(from), zonal::Planes<float>(to));
        });
    };
    ASSERT_EQ(message_of([&] {
                  zonal::rotate_all(order, R, layout, zonal::Planes<const float>(from),
                                    zonal::Planes<float>(to));
              }),
              "no error");
    const auto right = to;
    to.pop_back();
    EXPECT_THAT(message(), HasSubstr("planes of out: found " + std::to_string(n - 1)));
    to = right;
    to[1] = nullptr;
    EXPECT_THAT(message(), HasSubstr("plane 1 of out: found a null pointer"));
    to = right;
    to[1] = to[0] + 19;
    EXPECT_THAT(message(), HasSubstr("planes of out and planes of out: found arrays that overlap"));
    to = right;
    from[2] = to[3];
    EXPECT_THAT(message(), HasSubstr("planes of in and planes of out: found arrays that overlap"));
    EXPECT_THAT(refused([&] {
                    zonal::rotate_all(order, R, layout, zonal::Planes<const float>(in, 20),
                                      zonal::Planes<float>(out, 19));
                }),
                HasSubstr("stride of the planes of out: found 19"));
    EXPECT_THAT(refused([&] {
                    zonal::rotate_all(order, R, layout, zonal::Planes<const float>(in, 20),
                                      zonal::Planes<float>(std::span(out).first(20 * n - 1), 20));
                }),
                HasSubstr("length of planes of out: found " + std::to_string(20 * n - 1)));
}

TEST_F(runtime_batch_refusals, in_place_with_another_stride) {
    const BatchLayout layout{.count = 20, .stride = n, .out_stride = n + 1};
    EXPECT_THAT(
        refused([&] { zonal::rotate_all(order, R, layout, std::span<const float>(out), std::span(out)); }),
        HasSubstr("in and out: found arrays that overlap"));
}

TEST_F(runtime_batch_refusals, an_order_that_a_convention_lacks) {
    const BatchLayout layout{.count = 1, .convention = Convention::kUnityL2};
    const int other = zonal::compiled_orders().front() == 3 ? 4 : zonal::compiled_orders().front();
    in.resize(16);
    EXPECT_THAT(
        refused([&] { zonal::rotate_all(other, R, layout, std::span<const float>(in), std::span(out)); }),
        HasSubstr("order of a signal in the convention unity_l2"));
}

TEST_F(runtime_batch_refusals, colours_that_are_no_whole_vectors) {
    const std::vector<zonal::Rgb<float>> colours(2 * n + 1);
    std::vector<zonal::Rgb<float>> room(2 * n + 1);
    const std::span<const zonal::Rgb<float>> all(colours);
    EXPECT_THAT(refused([&] { zonal::rotate_all(order, R, all, std::span(room)); }),
                HasSubstr("length of in for order " + std::to_string(order) + ": found " +
                          std::to_string(2 * n + 1)));
    EXPECT_THAT(refused([&] { zonal::rotate_all(order, R, all.first(2 * n), std::span(room)); }),
                HasSubstr("length of out: found " + std::to_string(2 * n + 1)));
}

}  // namespace
