#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "batch/targets.hpp"
#include "support/accuracy.hpp"
#include "support/banner.hpp"
#include "support/flushed_denormals.hpp"
#include "support/oracle.hpp"
#include "zonal/basis.hpp"
#include "zonal/batch.hpp"
#include "zonal/eigen.hpp"
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
        in.assign(c.offset + c.extent(), kGuard<T>);
        const std::vector<T> values = random_values<T>(c.length() * c.layout.count, 11);
        for (std::size_t k = 0; k < c.layout.count; ++k)
            std::copy_n(values.data() + k * c.length(), c.length(), in.data() + c.offset + k * c.stride());
        out.assign(in.size() + kMargin, kGuard<T>);
    }

    void rotate(const zonal::Executor& executor = {}) {
        const std::span<const T> from = std::span<const T>(in).subspan(c.offset, c.extent());
        if (c.in_place) std::ranges::copy(in, out.begin());
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

    /// Guards behind the output. The input has none: sanitizers see what is read behind it.
    static constexpr std::size_t kMargin = 64;

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

/// The kernel that a batch runs, whose error is published: everything at once where that is faster, else the
/// two halves; dense blocks for three interleaved channels of float by one rotation (not on the baseline,
/// which may have no registers of four values).
template <class T>
std::string kernel_that_runs(std::string_view target, int order, Form form, int channels) {
    const bool has_blocks = std::is_same_v<T, float> && target != "baseline";
    if (form == Form::one_for_all && channels == 3 && has_blocks && 3 <= order && order <= 6) return "blocks";
    const bool is_at_once = form != Form::one_for_all && channels == 1 && (order <= 4 || order > 6);
    if (!is_at_once) return "apply";
    return order == 4 ? "rotate_tensor" : "rotate";
}

/// On every instruction set: banners promise it for fused instructions, zonal/batch.hpp for all.
template <class T>
double published_bound(std::string_view target, int order, Form form, int channels) {
    const zonal::banner::Bound bound =
        zonal::banner::bound(order, kernel_that_runs<T>(target, order, form, channels));
    return std::is_same_v<T, float> ? bound.float_bound : bound.double_bound;
}

using Problems = std::vector<zonal::accuracy::Problem>;

/// A batch that turns the signal of every problem, as a kernel that turns one after another. Each vector has
/// its problem's signal in one channel and those of its neighbours in the others. `quaternions` take the
/// place of the problems' matrices, where there are any.
template <class T>
class BatchAsKernel {
  public:
    BatchAsKernel(std::string_view target, const Problems& problems, int order, Form form, int channels,
                  const std::vector<Eigen::Quaternion<T>>& quaternions = {}, bool flushes_denormals = false)
        : target_(target),
          flushes_denormals_(flushes_denormals),
          batch_({.order = order,
                  .layout = {.count = form == Form::one_for_all ? kTogether : problems.size(),
                             .channels = channels},
                  .form = form}) {
        if (form == Form::one_for_all) return;
        for (std::size_t k = 0; k < problems.size(); ++k) {
            T* const rotation = batch_.rotation_values.data() + k * batch_.rotation_stride;
            if (form == Form::quaternions)
                std::copy_n(quaternions[k].coeffs().data(), 4, rotation);
            else
                std::transform(problems[k].rotation.begin(), problems[k].rotation.end(), rotation,
                               [](double entry) { return static_cast<T>(entry); });
            for (int channel = 0; channel < channels; ++channel) {
                const auto& signal = problems[(k + channel) % problems.size()].signal;
                put(k, (k + channel) % channels, std::vector<T>(signal.begin(), signal.end()).data());
            }
        }
        turn();
    }

    /// The problems' next result.
    void operator()(const T* R, const T* f, T* out) {
        const std::size_t k = next_++;
        const std::size_t row = k % batch_.c.layout.count, channel = k % batch_.c.layout.channels;
        if (batch_.c.form == Form::one_for_all) {
            batch_.matrices.front() =
                RotationMatrix<T>(Eigen::Map<const Eigen::Matrix<T, 3, 3, Eigen::RowMajor>>(R));
            put(row, channel, f);
            turn();
        }
        std::ranges::copy(batch_.vector(batch_.out, row, channel), out);
    }

  private:
    /// As many vectors as the largest pack has lanes, and one more.
    static constexpr std::size_t kTogether = 17;

    void put(std::size_t row, std::size_t channel, const T* f) {
        for (std::size_t i = 0; i < batch_.c.coefficients(); ++i)
            batch_.in[batch_.c.index(row, channel, i)] = f[i];
    }
    void turn() {
        ASSERT_TRUE(zonal::batch::choose_target(target_));
        std::optional<zonal::FlushedDenormals> flushed;
        if (flushes_denormals_) flushed.emplace();
        batch_.rotate();
    }

    std::string_view target_;
    bool flushes_denormals_;
    Batch<T> batch_;
    std::size_t next_ = 0;
};

/// Every result by the oracle, within what is published of the kernel that runs.
template <class T>
void expect_within_published_bounds(const Problems& problems, const zonal::oracle::Rotation& exact,
                                    const std::vector<std::string_view>& targets,
                                    const std::vector<Form>& forms,
                                    const std::vector<Eigen::Quaternion<T>>& quaternions = {},
                                    bool flushes_denormals = false) {
    const int order = exact.order();
    std::vector<zonal::accuracy::Contestant<T>> contestants;
    std::vector<double> bounds;
    for (const std::string_view target : targets) {
        for (const Form form : forms) {
            for (const int channels : {1, 3}) {
                const auto batch = std::make_shared<BatchAsKernel<T>>(target, problems, order, form, channels,
                                                                      quaternions, flushes_denormals);
                contestants.push_back(
                    {std::string(target) + ", form " + std::to_string(static_cast<int>(form)) + ", " +
                         std::to_string(channels) + " channels",
                     [batch](const T* R, const T* f, T* out) { (*batch)(R, f, out); },
                     zonal::banner::bound(order, kernel_that_runs<T>(target, order, form, channels)).excess});
                bounds.push_back(published_bound<T>(target, order, form, channels));
            }
        }
    }
    const auto worst = zonal::accuracy::worst_errors<T>(exact, problems, contestants);
    for (std::size_t k = 0; k < worst.size(); ++k)
        EXPECT_LE(worst[k].error, bounds[k])
            << "order " << order << ", " << contestants[k].name << ": " << worst[k].name;
}

/// Random rotations before the hard ones; of those of a kind beyond the first hundred, one in so many.
constexpr int kRandomRotations = 50, kThinning = 30;

/// The oracle's time grows as order^4.
std::vector<int> judged_orders() {
    std::vector<int> orders;
    for (const int order : zonal::compiled_orders())
        if (order <= 8) orders.push_back(order);
    return orders;
}

/// The matrices that a batch makes of quaternions: those by which it turns the three functions of band 1, a
/// product with R at every order, so that the least order makes exact copies.
template <class T>
std::vector<RotationMatrix<T>> matrices_in_use(const std::vector<Eigen::Quaternion<T>>& quaternions) {
    const std::size_t axis_of[] = {1, 2, 0};  // band 1 is y, z, x
    const int order = zonal::compiled_orders().front();
    const std::size_t length = static_cast<std::size_t>(order) * order;
    std::vector<T> rotations, in(3 * length * quaternions.size(), T(0)), out(in.size());
    for (std::size_t k = 0; k < 3 * quaternions.size(); ++k) {
        rotations.insert(rotations.end(), quaternions[k / 3].coeffs().data(),
                         quaternions[k / 3].coeffs().data() + 4);
        in[length * k + 1 + k % 3] = 1;
    }
    zonal::rotate_each(order, zonal::RotationQuaternions<T>(rotations), {.count = 3 * quaternions.size()},
                       std::span<const T>(in), std::span<T>(out));
    std::vector<RotationMatrix<T>> matrices;
    for (std::size_t k = 0; k < quaternions.size(); ++k) {
        Eigen::Matrix<T, 3, 3> matrix;
        for (std::size_t from = 0; from < 3; ++from)
            for (std::size_t to = 0; to < 3; ++to)
                matrix(axis_of[to], axis_of[from]) = out[length * (3 * k + from) + 1 + to];
        matrices.emplace_back(matrix);
    }
    return matrices;
}

using ExactQuaternion = Eigen::Quaternion<zonal::oracle::Real>;

/// The rotations of problems that a quaternion can be, in T.
template <class T>
std::vector<Eigen::Quaternion<T>> quaternions_of(Problems& problems) {
    std::vector<Eigen::Quaternion<T>> quaternions;
    std::erase_if(problems, [&](const zonal::accuracy::Problem& problem) {
        using Matrix = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;
        const Matrix matrix = Eigen::Map<const Matrix>(problem.rotation.data());
        const bool is_rotation = !problem.is_noisy && matrix.determinant() > 0;
        if (is_rotation) {
            quaternions.push_back(
                ExactQuaternion(matrix.cast<zonal::oracle::Real>()).normalized().template cast<T>());
        }
        return !is_rotation;
    });
    return quaternions;
}

/// The same of the problems' rotations as quaternions, judged by the matrices that the batch makes of them.
template <class T>
void expect_quaternions_within_published_bounds(int order, Problems problems,
                                                bool flushes_denormals = false) {
    const std::vector<Eigen::Quaternion<T>> quaternions = quaternions_of<T>(problems);
    const zonal::oracle::Rotation exact(order);
    for (const std::string_view target : zonal::batch::runnable_targets()) {
        ASSERT_TRUE(zonal::batch::choose_target(target));
        const std::vector<RotationMatrix<T>> matrices = matrices_in_use(quaternions);
        for (std::size_t k = 0; k < matrices.size(); ++k)
            std::copy_n(matrices[k].data(), 9, problems[k].rotation.begin());
        expect_within_published_bounds<T>(problems, exact, {target}, {Form::quaternions}, quaternions,
                                          flushes_denormals);
    }
}

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
    void SetUp() override { ASSERT_FALSE(zonal::batch::runnable_targets().empty()); }
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
                for (const int channels : {1, 3})
                    for (const bool in_place : {false, true})
                        expect_turned<TypeParam>(
                            {.order = order,
                             .layout = {.count = 37, .stride = channels * length + gap, .channels = channels},
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

TYPED_TEST(runtime_batch, hard_rotations_and_signals_are_within_the_published_bounds) {
    for (const int order : judged_orders()) {
        const Problems problems =
            zonal::accuracy::problems<TypeParam>(order, kRandomRotations, kThinning, 1000 + order);
        expect_within_published_bounds<TypeParam>(problems, zonal::oracle::Rotation(order),
                                                  zonal::batch::runnable_targets(),
                                                  {Form::matrices, Form::one_for_all});
    }
}

TYPED_TEST(runtime_batch, quaternions_become_matrices_but_for_rounding) {
    using T = TypeParam;
    Problems problems = zonal::accuracy::problems<T>(2, 1000, 1, 17);
    const std::vector<Eigen::Quaternion<T>> quaternions = quaternions_of<T>(problems);
    const double unit = static_cast<double>(std::numeric_limits<T>::epsilon()) / 2;
    for (const std::string_view target : zonal::batch::runnable_targets()) {
        ASSERT_TRUE(zonal::batch::choose_target(target));
        SCOPED_TRACE(target);
        const std::vector<RotationMatrix<T>> found = matrices_in_use(quaternions);
        for (std::size_t k = 0; k < found.size(); ++k) {
            // The polynomial of the quaternion as it is given. On the diagonal, 1 - 2 (y^2 + z^2), products,
            // their sum and the difference round 2, 2 and 1 at the most; elsewhere 1 and 1.
            const auto wanted = quaternions[k].template cast<zonal::oracle::Real>().toRotationMatrix();
            const Eigen::Matrix<zonal::oracle::Real, 3, 3> error =
                (found[k].matrix().template cast<zonal::oracle::Real>() - wanted).cwiseAbs();
            for (int i = 0; i < 9; ++i)
                ASSERT_LE(static_cast<double>(error(i / 3, i % 3)), (i % 4 == 0 ? 5.001 : 2.001) * unit)
                    << problems[k].name << ", value " << i;
        }
    }
}

TYPED_TEST(runtime_batch, hard_quaternions_are_within_the_published_bounds) {
    for (const int order : judged_orders())
        expect_quaternions_within_published_bounds<TypeParam>(
            order, zonal::accuracy::problems<TypeParam>(order, kRandomRotations, kThinning, 2000 + order));
}

/// Squares of what R tells of a pole's direction are lost where denormals are flushed.
TYPED_TEST(runtime_batch, tiny_tilts_are_within_the_published_bounds_where_denormals_are_flushed) {
    if (!zonal::FlushedDenormals::kIsSupported) GTEST_SKIP() << "not known how to flush denormals here";
    for (const int order : zonal::compiled_orders()) {
        const Problems problems = zonal::accuracy::tiny_tilts(order, 3000 + order);
        expect_within_published_bounds<TypeParam>(problems, zonal::oracle::Rotation(order),
                                                  zonal::batch::runnable_targets(),
                                                  {Form::matrices, Form::one_for_all}, {}, true);
        expect_quaternions_within_published_bounds<TypeParam>(order, problems, true);
    }
}

TYPED_TEST(runtime_batch, identity_is_right_when_denormals_are_flushed) {
    if (!zonal::FlushedDenormals::kIsSupported) GTEST_SKIP() << "not known how to flush denormals here";
    using T = TypeParam;
    this->on_every_target_and_order([](int order) {
        for (const Form form : kForms) {
            for (const int channels : {1, 3}) {
                Batch<T> batch({.order = order, .layout = {.count = 33, .channels = channels}, .form = form});
                const T identity[] = {1, 0, 0, 0, 1, 0, 0, 0, 1}, unit[] = {0, 0, 0, 1};
                for (std::size_t k = 0; k < batch.matrices.size(); ++k) {
                    batch.matrices[k] = RotationMatrix<T>();
                    std::copy_n(form == Form::quaternions ? unit : identity, batch.rotation_stride,
                                batch.rotation_values.data() + k * batch.rotation_stride);
                }
                {
                    const zonal::FlushedDenormals flushed;
                    batch.rotate();
                }
                const double bound = published_bound<T>(zonal::batch::chosen_target(), order, form, channels);
                for (std::size_t k = 0; k < batch.c.layout.count; ++k) {
                    for (int channel = 0; channel < channels; ++channel) {
                        double error = 0, norm = 0;
                        const std::vector<T> f = batch.vector(batch.in, k, channel);
                        const std::vector<T> found = batch.vector(batch.out, k, channel);
                        for (std::size_t i = 0; i < f.size(); ++i) {
                            error += std::pow(static_cast<double>(found[i]) - static_cast<double>(f[i]), 2);
                            norm += std::pow(static_cast<double>(f[i]), 2);
                        }
                        ASSERT_LE(std::sqrt(error / norm), bound)
                            << "order " << order << ", form " << static_cast<int>(form) << ", vector " << k;
                    }
                }
            }
        }
    });
}

TYPED_TEST(runtime_batch, denormals_keep_their_absolute_accuracy) {
    using T = TypeParam;
    using zonal::oracle::Real;
    constexpr T kSmallest = std::numeric_limits<T>::denorm_min();
    std::vector<zonal::oracle::Rotation> oracles;
    for (const int order : judged_orders()) oracles.emplace_back(order);
    for (const std::string_view target : zonal::batch::runnable_targets()) {
        ASSERT_TRUE(zonal::batch::choose_target(target));
        SCOPED_TRACE(target);
        for (const zonal::oracle::Rotation& exact : oracles) {
            const int order = exact.order();
            for (const Form form : {Form::matrices, Form::one_for_all}) {
                for (const int channels : {1, 3}) {
                    Batch<T> batch(
                        {.order = order, .layout = {.count = 17, .channels = channels}, .form = form});
                    for (T& value : batch.in) value = std::round(1000 * value) * kSmallest;
                    batch.rotate();
                    for (const std::size_t k : {0, 7, 15, 16}) {
                        const std::size_t channel = k % channels;
                        const std::vector<T> f = batch.vector(batch.in, k, channel);
                        const std::vector<T> found = batch.vector(batch.out, k, channel);
                        zonal::oracle::Matrix3 matrix;
                        std::copy_n(batch.matrix(k).data(), 9, matrix.begin());
                        const std::vector<Real> wanted = exact(matrix, {f.begin(), f.end()});
                        for (std::size_t i = 0; i < f.size(); ++i)
                            ASSERT_LE(std::abs(found[i] - wanted[i]) / kSmallest, 4 * order * order)
                                << "order " << order << ", form " << static_cast<int>(form) << ", "
                                << channels << " channels, vector " << k << ", coefficient " << i;
                    }
                }
            }
        }
    }
}

TYPED_TEST(runtime_batch, nan_in_one_coefficient_leaves_the_bits_of_all_others) {
    using T = TypeParam;
    this->on_every_target_and_order([](int order) {
        for (const Form form : kForms) {
            for (const int channels : {1, 3}) {
                const Case c{.order = order, .layout = {.count = 19, .channels = channels}, .form = form};
                Batch<T> clean(c);
                clean.rotate();
                for (const std::size_t bad : {1, 18}) {  // in a pack, and in the rest
                    for (int band = 0; band < order; ++band) {
                        const std::size_t channel = band % channels;
                        Batch<T> batch(c);
                        batch.in[c.index(bad, channel, band * band + band)] =
                            std::numeric_limits<T>::quiet_NaN();
                        batch.rotate();
                        bool is_met = false;
                        for (int i = band * band; i < (band + 1) * (band + 1); ++i) {
                            T& value = batch.out[c.index(bad, channel, i)];
                            is_met |= std::isnan(value);
                            value = clean.out[c.index(bad, channel, i)];
                        }
                        EXPECT_TRUE(is_met);
                        EXPECT_EQ(batch.out, clean.out)
                            << "order " << order << ", form " << static_cast<int>(form) << ", vector " << bad
                            << ", channel " << channel << ", band " << band;
                    }
                }
            }
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
                for (const auto& [form, channels] :
                     {std::pair(Form::matrices, 1), std::pair(Form::one_for_all, 1),
                      std::pair(Form::one_for_all, 3)}) {
                    SCOPED_TRACE(testing::Message() << target << ", order " << order << ", offset " << offset
                                                    << ", channels " << channels);
                    Batch<T> batch({.order = order,
                                    .layout = {.count = count, .channels = channels},
                                    .form = form,
                                    .offset = offset});
                    batch.rotate();
                    for (std::size_t k = 0; k < count; k += k < 2000 || k + 200 > count ? 1 : 97)
                        batch.expect_vector_turned(k, channels - 1);
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
                for (const int channels : {1, 3}) {
                    Batch<TypeParam> whole({.order = order,
                                            .layout = {.count = 150, .channels = channels},
                                            .form = form,
                                            .offset = 1});
                    whole.rotate();
                    for (const zonal::Executor& executor : {backwards, zonal::on_all_cores(16)}) {
                        Batch<TypeParam> parts(whole.c);
                        parts.rotate(executor);
                        EXPECT_EQ(parts.out, whole.out) << "order " << order << ", channels " << channels;
                    }
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
