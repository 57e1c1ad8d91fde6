// What every order's `rotate`, and the kernels that do the same, must do by their mathematics, whatever the
// rounding: each test runs for all orders.
#include <gtest/gtest.h>

#include <numbers>

#include "property/kernel_checks.hpp"
#include "support/banner.hpp"
#include "support/case_count.hpp"
#include "support/flushed_denormals.hpp"

namespace zonal {
namespace {

/// Relative rounding error that two roundings of `rotate` can differ by: twice the contract of the order.
double tolerance(int order) { return 2 * accuracy::contract("rotate", order, false); }

/// What `rotate` must do in each type, within what is published for it.
template <class T>
struct TypedProperties {
    const CompiledOrder& compiled;
    const int N = compiled.order;
    std::mt19937_64 random{static_cast<unsigned>(N)};
    const std::vector<double> signal = cases::random_signal(N, random);
    const std::vector<T> f{signal.begin(), signal.end()};
    static constexpr int kRotations = 20;

    const banner::Bound published = banner::bound(N, "rotate");

    /// Of one turn, relative to the signal: its distance from the turn by the nearest orthonormal matrix.
    double bound(const Matrix& R) const {
        return (std::is_same_v<T, float> ? published.float_bound : published.double_bound) +
               published.excess * static_cast<double>(oracle::orthonormality_error(as_given<T>(R)));
    }

    std::vector<T> rotate(const Matrix& R, const std::vector<T>& in) const {
        return rotated(compiled.in<T>().rotate, R, in);
    }

    void identity_returns_the_input() {
        EXPECT_LE(distance(rotate(kIdentity, f), f), bound(kIdentity) * norm(f));
    }

    void identity_is_right_when_denormals_are_flushed() {
        const std::vector<T> result = [&] {
            const FlushedDenormals flushed;
            return rotate(kIdentity, f);
        }();
        EXPECT_LE(distance(result, f), bound(kIdentity) * norm(f));
    }

    void inverse_after_forward_returns_the_input() {
        for (int k = 0; k < kRotations; ++k) {
            const Matrix R = cases::random_rotation(random);
            const std::vector<T> back = rotate(cases::transposed(R), rotate(R, f));
            EXPECT_LE(distance(back, f), 2 * bound(R) * norm(f));
        }
    }

    void two_rotations_are_their_product() {
        for (int k = 0; k < kRotations; ++k) {
            const Matrix first = cases::random_rotation(random), second = cases::random_rotation(random);
            const Matrix both = cases::rounded_product<T>(second, first);
            const std::vector<T> in_turn = rotate(second, rotate(first, f));
            // Rounded matrices are not quite each other's product: an angle between them turns band l by l
            // times as much, and sqrt 2 times the angle is their distance.
            const oracle::Matrix3 a = oracle::nearest_orthonormal(as_given<T>(first)),
                                  b = oracle::nearest_orthonormal(as_given<T>(second)),
                                  ba = oracle::nearest_orthonormal(as_given<T>(both));
            oracle::Real apart = 0;
            for (int i = 0; i < 3; ++i) {
                for (int j = 0; j < 3; ++j) {
                    oracle::Real entry = -ba[3 * i + j];
                    for (int n = 0; n < 3; ++n) entry += b[3 * i + n] * a[3 * n + j];
                    apart += entry * entry;
                }
            }
            const double limit = bound(first) + bound(second) + bound(both) +
                                 (N - 1) * static_cast<double>(std::sqrt(apart / 2));
            EXPECT_LE(distance(in_turn, rotate(both, f)), limit * norm(f));
        }
    }
};

struct Properties {
    const CompiledOrder& compiled;
    const int N = compiled.order;
    const RotateKernels<double>& kernels = compiled.in_double;
    std::mt19937_64 random{static_cast<unsigned>(N)};
    const std::vector<double> f = cases::random_signal(N, random);
    const Matrix rotation = cases::random_rotation(random);

    std::vector<double> rotate(const Matrix& R, const std::vector<double>& in) const {
        return rotated(kernels.rotate, R, in);
    }
    /// By `prepare` and `apply`.
    void run_halves(const double* R, const double* in, double* out) const {
        std::vector<double> scalars(compiled.scalars);
        kernels.prepare(R, scalars.data());
        kernels.apply(scalars.data(), in, out);
    }

    void x_turns_into_y() {
        // Band 1 is (y, z, x): a quarter turn about z takes the lobe along x to the lobe along y.
        std::vector<double> x(N * N, 0);
        x[3] = 1;
        const auto y = rotate({0, -1, 0, 1, 0, 0, 0, 0, 1}, x);
        EXPECT_NEAR(y[1], 1, tolerance(N));
        EXPECT_NEAR(y[3], 0, tolerance(N));
    }

    void zonal_projection_turns_with_the_direction() {
        // Hable: R·P(n) = P(M n), P the projection of a direction.
        std::normal_distribution<oracle::Real> normal;
        oracle::Vector3 n{normal(random), normal(random), normal(random)};
        const oracle::Real length = std::hypot(n[0], n[1], n[2]);
        for (auto& component : n) component /= length;
        oracle::Vector3 turned{};
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) turned[i] += rotation[3 * i + j] * n[j];
        const auto before = oracle::basis(N, n), after = oracle::basis(N, turned);
        const std::vector<double> p(before.begin(), before.end()), expected(after.begin(), after.end());
        EXPECT_LE(distance(rotate(rotation, p), expected), tolerance(N) * norm(p));
    }

    void clamped_cosine_turns_into_kirschs_closed_form() {
        // max(cos θ, 0) about z has c_0 = √π/2 and c_1^0 = √(π/3); turned onto n, band 1 is √(π/3) (n_y, n_z,
        // n_x). Kirsch has the Condon-Shortley sign, so minus signs where m is odd. Here from the definition:
        // c_l^0 = 2π ∫₀¹ z y_l^0(z) dz by Simpson's rule, exact for polynomials of degree 3, so for both
        // bands.
        const auto integrand = [](int l, oracle::Real z) {
            return z * oracle::basis(2, {std::sqrt(1 - z * z), 0, z})[l * (l + 1)];
        };
        std::vector<double> lobe(N * N, 0);
        for (const int l : {0, 1})
            lobe[l * (l + 1)] =
                static_cast<double>(2 * std::numbers::pi_v<oracle::Real> / 6 *
                                    (integrand(l, 0) + 4 * integrand(l, 0.5L) + integrand(l, 1)));
        const auto turned = rotate(rotation, lobe);
        const double nx = rotation[2], ny = rotation[5], nz = rotation[8];
        const double c0 = std::sqrt(std::numbers::pi) / 2, c1 = std::sqrt(std::numbers::pi / 3);
        const double expected[4] = {c0, c1 * ny, c1 * nz, c1 * nx};
        for (int i = 0; i < 4; ++i) EXPECT_NEAR(turned[i], expected[i], tolerance(N) * norm(lobe));
    }

    template <class Run>
    void expect_same_in_place(Run run) {
        std::vector<double> apart(N * N), in_place = f;
        run(f.data(), apart.data());
        run(in_place.data(), in_place.data());
        EXPECT_EQ(apart, in_place);
    }
    void every_kernel_may_overwrite_its_input() {
        const double* r = rotation.data();
        expect_same_in_place([&](const double* in, double* out) { kernels.rotate(r, in, out); });
        expect_same_in_place([&](const double* in, double* out) { kernels.rotate_accurate(r, in, out); });
        expect_same_in_place([&](const double* in, double* out) { run_halves(r, in, out); });
    }

    void a_value_that_is_not_finite_stays_in_its_band() {
        for (const RotateKernel<double> kernel : {kernels.rotate, kernels.rotate_accurate})
            expect_bands_apart(
                N, f, [&](const std::vector<double>& signal) { return rotated(kernel, rotation, signal); });
        expect_bands_apart(N, f, [&](const std::vector<double>& signal) {
            std::vector<double> out(signal.size());
            run_halves(rotation.data(), signal.data(), out.data());
            return out;
        });
    }

    void denormals_keep_their_absolute_accuracy() {
        for (const RotateKernel<float> kernel : {compiled.in_float.rotate, compiled.in_float.rotate_accurate})
            expect_denormals_within_4_n_squared<float>(N, rotation, f, kernel);
        for (const RotateKernel<double> kernel : {kernels.rotate, kernels.rotate_accurate})
            expect_denormals_within_4_n_squared<double>(N, rotation, f, kernel);
    }

    void energy_of_every_band_survives_a_chain_of_small_rotations() {
        // 10^6 steps of one vector; n steps may lose n times the contract, orthonormality of the step
        // included.
        const auto steps = static_cast<int>(cases::some_of(1000000));
        std::vector<double> v = f;
        const Matrix step = cases::about_axis({2.0 / 7, 3.0 / 7, 6.0 / 7}, 1e-3);
        for (int k = 0; k < steps; ++k) kernels.rotate(step.data(), v.data(), v.data());
        oracle::Matrix3 given;
        std::copy(step.begin(), step.end(), given.begin());
        const double lost = steps * (accuracy::contract("rotate", N, false) +
                                     (N - 1) * static_cast<double>(oracle::orthonormality_error(given)) / 2);
        for (int l = 0; l < N; ++l) {
            const std::vector<double> before(f.begin() + l * l, f.begin() + (l + 1) * (l + 1));
            const std::vector<double> after(v.begin() + l * l, v.begin() + (l + 1) * (l + 1));
            EXPECT_NEAR(norm(after), norm(before), lost * norm(before)) << "band " << l;
        }
    }

    void an_rgb_signal_is_three_scalar_ones() {
        std::vector<Rgb<double>> rgb(N * N), out(N * N);
        const auto g = cases::random_signal(N, random), b = cases::random_signal(N, random);
        for (int i = 0; i < N * N; ++i) rgb[i] = {f[i], g[i], b[i]};
        compiled.rotate_rgb(rotation.data(), rgb.data(), out.data());
        // A value of several channels takes another kernel than one vector does: equal but for rounding.
        std::vector<double> red, green, blue;
        for (const Rgb<double>& value : out) {
            red.push_back(value.r);
            green.push_back(value.g);
            blue.push_back(value.b);
        }
        EXPECT_LE(distance(red, rotate(rotation, f)), tolerance(N) * norm(f));
        EXPECT_LE(distance(green, rotate(rotation, g)), tolerance(N) * norm(g));
        EXPECT_LE(distance(blue, rotate(rotation, b)), tolerance(N) * norm(b));
    }

    void dense_blocks_and_prepared_scalars_turn_as_rotate_does() {
        const std::vector<double> expected = rotate(rotation, f);
        std::vector<double> dense(compiled.blocks_size()), product(N * N, 0), applied(N * N);
        kernels.blocks(rotation.data(), dense.data());
        const double* entry = dense.data();
        for (int l = 0; l < N; ++l)
            for (int i = l * l; i < (l + 1) * (l + 1); ++i)
                for (int j = l * l; j < (l + 1) * (l + 1); ++j) product[i] += *entry++ * f[j];
        EXPECT_LE(distance(product, expected), tolerance(N) * norm(f));
        run_halves(rotation.data(), f.data(), applied.data());
        EXPECT_LE(distance(applied, expected), tolerance(N) * norm(f));
    }

    template <class Run>
    void expect_mirrors_taken(Run run) {
        Matrix mirror = rotation;
        for (double& entry : mirror) entry = -entry;
        std::vector<double> out(N * N), expected = rotate(rotation, f);
        run(mirror.data(), f.data(), out.data());
        for (int l = 1; l < N; l += 2)
            for (int i = l * l; i < (l + 1) * (l + 1); ++i) expected[i] = -expected[i];
        EXPECT_LE(distance(out, expected), tolerance(N) * norm(f));
    }
    void the_accurate_kernel_takes_mirrors() { expect_mirrors_taken(kernels.rotate_accurate); }
};

/// What `rotate_tensor` must do.
struct TensorProperties : Properties {
    const RotateKernel<double> kernel = compiled.in_double.rotate_tensor;

    void it_turns_as_rotate_does() {
        EXPECT_LE(distance(rotated(kernel, rotation, f), rotate(rotation, f)), tolerance(N) * norm(f));
    }
    void it_may_overwrite_its_input() {
        expect_same_in_place([&](const double* in, double* out) { kernel(rotation.data(), in, out); });
    }
    void it_keeps_a_value_that_is_not_finite_in_its_band() {
        expect_bands_apart(
            N, f, [&](const std::vector<double>& signal) { return rotated(kernel, rotation, signal); });
    }
    void it_takes_mirrors() { expect_mirrors_taken(kernel); }
};

/// Runs a check for every order that is compiled in.
#define ZONAL_CHECK(suite, check)                                \
    for (const CompiledOrder& compiled : compiled_orders()) {    \
        SCOPED_TRACE("order " + std::to_string(compiled.order)); \
        suite{compiled}.check();                                 \
    }
#define ZONAL_TEST(suite, name) \
    TEST(suite, name) { ZONAL_CHECK(suite, name) }
#define ZONAL_TYPED_TEST(suite, name)                                                             \
    TEST(suite, name##_in_float){ZONAL_CHECK(suite<float>, name)} TEST(suite, name##_in_double) { \
        ZONAL_CHECK(suite<double>, name)                                                          \
    }
#define ZONAL_TENSOR_TEST(suite, name)                               \
    TEST(suite, name) {                                              \
        for (const CompiledOrder& compiled : orders_with_tensor()) { \
            SCOPED_TRACE("order " + std::to_string(compiled.order)); \
            suite{{compiled}}.name();                                \
        }                                                            \
    }
ZONAL_TYPED_TEST(TypedProperties, identity_returns_the_input)
ZONAL_TYPED_TEST(TypedProperties, identity_is_right_when_denormals_are_flushed)
ZONAL_TYPED_TEST(TypedProperties, inverse_after_forward_returns_the_input)
ZONAL_TYPED_TEST(TypedProperties, two_rotations_are_their_product)
ZONAL_TEST(Properties, x_turns_into_y)
ZONAL_TEST(Properties, zonal_projection_turns_with_the_direction)
ZONAL_TEST(Properties, clamped_cosine_turns_into_kirschs_closed_form)
ZONAL_TEST(Properties, every_kernel_may_overwrite_its_input)
ZONAL_TEST(Properties, a_value_that_is_not_finite_stays_in_its_band)
ZONAL_TEST(Properties, denormals_keep_their_absolute_accuracy)
ZONAL_TEST(Properties, energy_of_every_band_survives_a_chain_of_small_rotations)
ZONAL_TEST(Properties, an_rgb_signal_is_three_scalar_ones)
ZONAL_TEST(Properties, dense_blocks_and_prepared_scalars_turn_as_rotate_does)
ZONAL_TEST(Properties, the_accurate_kernel_takes_mirrors)
ZONAL_TENSOR_TEST(TensorProperties, it_turns_as_rotate_does)
ZONAL_TENSOR_TEST(TensorProperties, it_may_overwrite_its_input)
ZONAL_TENSOR_TEST(TensorProperties, it_keeps_a_value_that_is_not_finite_in_its_band)
ZONAL_TENSOR_TEST(TensorProperties, it_takes_mirrors)
#undef ZONAL_CHECK
#undef ZONAL_TEST
#undef ZONAL_TYPED_TEST
#undef ZONAL_TENSOR_TEST

}  // namespace
}  // namespace zonal
