// What the lobe kernels of every order must do by their mathematics, whatever the rounding.
#include <gtest/gtest.h>

#include "property/kernel_checks.hpp"

namespace zonal {
namespace {

double lobe_tolerance(int order) { return 2 * accuracy::contract("rotate_zhf", order, false); }

/// What the lobe kernels of a variant must do.
struct LobeProperties {
    const LobeVariant& variant;
    const int N = variant.order;
    const LobeKernels<double>& kernels = variant.in_double;
    std::mt19937_64 random{static_cast<unsigned>(N)};
    const std::vector<double> f = cases::random_signal(N, random);
    const Matrix rotation = cases::random_rotation(random);

    std::vector<double> directions_at(const Matrix& R) const {
        std::vector<double> directions(3 * variant.directions());
        kernels.lobes(R.data(), directions.data());
        return directions;
    }
    std::vector<double> still_directions() const { return directions_at(kIdentity); }

    void factorize_and_expand_undo_each_other() {
        std::vector<double> z(variant.weights()), back(N * N);
        kernels.factorize(f.data(), z.data());
        kernels.expand(z.data(), back.data());
        EXPECT_LE(distance(back, f), lobe_tolerance(N) * norm(f));
    }

    void weights_of_the_lobes_sum_to_the_signal() {
        // f(ω) = sum over bands and lobes of z_ld * sum_m y_lm(ω_d) y_lm(ω), by the oracle's basis.
        std::vector<double> z(variant.weights());
        kernels.factorize(f.data(), z.data());
        const std::vector<double> directions = still_directions();
        std::vector<double> sum(N * N, 0);
        for (int l = 0; l < N; ++l) {
            for (int d = 0; d < variant.count(l); ++d) {
                const double* at = &directions[3 * variant.direction(l, d)];
                const auto y = oracle::basis(N, {at[0], at[1], at[2]});
                for (int i = l * l; i < (l + 1) * (l + 1); ++i)
                    sum[i] += z[variant.weight(l, d)] * static_cast<double>(y[i]);
            }
        }
        EXPECT_LE(distance(sum, f), lobe_tolerance(N) * norm(f));
    }

    void turned_lobes_are_r_times_those_of_the_identity() {
        const std::vector<double> still = still_directions(), turned = directions_at(rotation);
        for (int d = 0; d < variant.directions(); ++d) {
            for (int i = 0; i < 3; ++i) {
                double expected = 0;
                for (int j = 0; j < 3; ++j) expected += rotation[3 * i + j] * still[3 * d + j];
                EXPECT_NEAR(turned[3 * d + i], expected, 4 * std::numeric_limits<double>::epsilon());
            }
        }
    }

    void resample_recovers_the_rotated_signal_from_samples() {
        // eq. 11: samples of every band of the unrotated signal at Rᵀ (lobe direction), by the oracle.
        const std::vector<double> directions = still_directions();
        std::vector<double> samples(variant.weights()), out(N * N);
        for (int l = 0; l < N; ++l) {
            for (int d = 0; d < variant.count(l); ++d) {
                oracle::Vector3 back{};
                for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j)
                        back[i] += rotation[3 * j + i] * directions[3 * variant.direction(l, d) + j];
                const auto y = oracle::basis(N, back);
                oracle::Real sample = 0;
                for (int i = l * l; i < (l + 1) * (l + 1); ++i) sample += f[i] * y[i];
                samples[variant.weight(l, d)] = static_cast<double>(sample);
            }
        }
        kernels.resample(samples.data(), out.data());
        EXPECT_LE(distance(out, rotated(compiled_order(N).in_double.rotate, rotation, f)),
                  lobe_tolerance(N) * norm(f));
    }

    /// Arrays as long as the longer of input and output, so that one may be the other.
    template <class Run>
    void expect_same_in_place(Run run) {
        std::vector<double> in(variant.weights(), 0.0), apart(variant.weights(), 0.0);
        for (double& value : in) value = std::uniform_real_distribution(-1.0, 1.0)(random);
        std::vector<double> in_place = in;
        run(in.data(), apart.data());
        run(in_place.data(), in_place.data());
        for (int i = 0; i < N * N; ++i) EXPECT_EQ(apart[i], in_place[i]);
    }
    void products_may_overwrite_their_input() {
        for (const OneInputKernel<double> kernel : {kernels.factorize, kernels.expand, kernels.resample})
            expect_same_in_place(kernel);
    }

    void rotate_zhf_may_overwrite_its_input() {
        expect_same_in_place(
            [&](const double* in, double* out) { kernels.rotate_zhf(rotation.data(), in, out); });
    }

    void rotate_zhf_keeps_a_value_that_is_not_finite_in_its_band() {
        expect_bands_apart(N, f, [&](const std::vector<double>& signal) {
            return rotated(kernels.rotate_zhf, rotation, signal);
        });
    }

    void denormals_keep_their_absolute_accuracy_in_rotate_zhf() {
        expect_denormals_within_4_n_squared<float>(N, rotation, f, variant.in_float.rotate_zhf);
        expect_denormals_within_4_n_squared<double>(N, rotation, f, kernels.rotate_zhf);
    }

    void factorize_keeps_a_value_that_is_not_finite_in_its_band() {
        std::vector<double> spoilt = f, clean(variant.weights()), result(variant.weights());
        spoilt[1] = std::numeric_limits<double>::quiet_NaN();
        kernels.factorize(f.data(), clean.data());
        kernels.factorize(spoilt.data(), result.data());
        for (int i = variant.weight(2, 0); i < variant.weights(); ++i) EXPECT_EQ(result[i], clean[i]);
    }

    void factorize_takes_its_constants_in_the_signals_value_type() {
        std::vector<Rgb<double>> rgb(N * N), out(variant.weights());
        for (int i = 0; i < N * N; ++i) rgb[i] = {f[i], 0, 0};
        std::vector<double> z(variant.weights());
        variant.factorize_rgb(rgb.data(), out.data());
        kernels.factorize(f.data(), z.data());
        for (int i = 0; i < variant.weights(); ++i) EXPECT_EQ(out[i].r, z[i]);
    }
};

using Layout = LobeVariant::Layout;

/// Runs a check for every order's shared lobes and its ring, or its lobes of each band's own.
#define ZONAL_CHECK(suite, check, ...)                                                 \
    for (const LobeVariant& variant : lobes_of_all_orders({__VA_ARGS__})) {            \
        SCOPED_TRACE("order " + std::to_string(variant.order) + " " + variant.prefix); \
        suite{variant}.check();                                                        \
    }
#define ZONAL_LOBE_TEST(suite, name) \
    TEST(suite, name) { ZONAL_CHECK(suite, name, Layout::shared, Layout::ring) }
#define ZONAL_PRODUCT_TEST(suite, name) \
    ZONAL_LOBE_TEST(suite, name)        \
    TEST(PerBand##suite, name) { ZONAL_CHECK(suite, name, Layout::per_band) }
ZONAL_PRODUCT_TEST(LobeProperties, factorize_and_expand_undo_each_other)
ZONAL_PRODUCT_TEST(LobeProperties, weights_of_the_lobes_sum_to_the_signal)
ZONAL_PRODUCT_TEST(LobeProperties, turned_lobes_are_r_times_those_of_the_identity)
ZONAL_PRODUCT_TEST(LobeProperties, resample_recovers_the_rotated_signal_from_samples)
ZONAL_PRODUCT_TEST(LobeProperties, products_may_overwrite_their_input)
ZONAL_PRODUCT_TEST(LobeProperties, factorize_keeps_a_value_that_is_not_finite_in_its_band)
ZONAL_PRODUCT_TEST(LobeProperties, factorize_takes_its_constants_in_the_signals_value_type)
ZONAL_LOBE_TEST(LobeProperties, rotate_zhf_may_overwrite_its_input)
ZONAL_LOBE_TEST(LobeProperties, rotate_zhf_keeps_a_value_that_is_not_finite_in_its_band)
ZONAL_LOBE_TEST(LobeProperties, denormals_keep_their_absolute_accuracy_in_rotate_zhf)
#undef ZONAL_CHECK
#undef ZONAL_LOBE_TEST
#undef ZONAL_PRODUCT_TEST

}  // namespace
}  // namespace zonal
