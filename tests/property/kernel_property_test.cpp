// What every order's kernels must do by their mathematics, whatever the rounding: each test runs for all
// orders.
#include <fmt/format.h>
#include <gtest/gtest.h>
#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>
#include <type_traits>

#include "support/accuracy.hpp"
#include "support/banner.hpp"
#include "support/counting.hpp"
#include "support/kernels.hpp"
#include "zonal/rgb.hpp"

namespace zonal {
namespace {

using Matrix = cases::Matrix;

/// Relative rounding error that two roundings of `rotate` can differ by: twice the contract of the order.
template <int N>
double tolerance() {
    return 2 * accuracy::contract("rotate", N, false);
}

template <class T>
double norm(const std::vector<T>& v) {
    double sum = 0;
    for (const T x : v) sum += static_cast<double>(x) * static_cast<double>(x);
    return std::sqrt(sum);
}

template <class T>
double distance(const std::vector<T>& a, const std::vector<T>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
        sum += difference * difference;
    }
    return std::sqrt(sum);
}

template <class T>
std::array<T, 9> rounded(const Matrix& rotation) {
    std::array<T, 9> r;
    std::transform(rotation.begin(), rotation.end(), r.begin(),
                   [](double entry) { return static_cast<T>(entry); });
    return r;
}

/// A rotation as T has it.
template <class T>
oracle::Matrix3 as_given(const Matrix& rotation) {
    const std::array<T, 9> r = rounded<T>(rotation);
    oracle::Matrix3 given;
    std::copy(r.begin(), r.end(), given.begin());
    return given;
}

template <int N, class T>
std::vector<T> rotated(const Matrix& rotation, const std::vector<T>& f) {
    std::vector<T> out(f.size());
    Order<N>::rotate(rounded<T>(rotation).data(), f.data(), out.data());
    return out;
}

/// `turn`: a signal's turn by one rotation.
template <int N, class Turn>
void expect_bands_apart(const std::vector<double>& f, Turn turn) {
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        for (int broken = 0; broken < N; ++broken) {
            std::vector<double> spoilt = f;
            spoilt[broken * broken] = bad;
            const std::vector<double> clean = turn(f), result = turn(spoilt);
            for (int i = 0; i < N * N; ++i) {
                const bool is_in_band = broken * broken <= i && i < (broken + 1) * (broken + 1);
                if (is_in_band) continue;
                EXPECT_EQ(result[i], clean[i]) << "band " << broken << " leaked into " << i;
            }
            EXPECT_FALSE(std::isfinite(norm(result)));
        }
    }
}

/// `turn(R, f, out)`: a kernel in T.
template <int N, class T, class Turn>
void expect_denormals_within_4_n_squared(const Matrix& rotation, const std::vector<double>& f, Turn turn) {
    const T smallest = std::numeric_limits<T>::denorm_min();
    std::vector<T> tiny(N * N), out(N * N);
    std::vector<double> whole(N * N);
    for (int i = 0; i < N * N; ++i) {
        whole[i] = std::round(1000 * f[i]);
        tiny[i] = static_cast<T>(whole[i]) * smallest;
    }
    turn(rounded<T>(rotation).data(), tiny.data(), out.data());
    const auto expected = oracle::Rotation(N)(as_given<T>(rotation), {whole.begin(), whole.end()});
    for (int i = 0; i < N * N; ++i)
        EXPECT_LE(std::abs(static_cast<oracle::Real>(out[i]) / smallest - expected[i]), 4 * N * N);
}

/// What `rotate` must do in each type, within what is published for it.
template <int N, class T>
struct TypedProperties {
    std::mt19937_64 random{N};
    const std::vector<double> signal = cases::random_signal(N, random);
    const std::vector<T> f{signal.begin(), signal.end()};
    const Matrix identity{1, 0, 0, 0, 1, 0, 0, 0, 1};
    static constexpr int kRotations = 20;

    const banner::Bound published = banner::bound(N, "rotate");

    /// Of one turn, relative to the signal: its distance from the turn by the nearest orthonormal matrix.
    double bound(const Matrix& R) const {
        return (std::is_same_v<T, float> ? published.float_bound : published.double_bound) +
               published.excess * static_cast<double>(oracle::orthonormality_error(as_given<T>(R)));
    }

    void identity_returns_the_input() {
        EXPECT_LE(distance(rotated<N>(identity, f), f), bound(identity) * norm(f));
    }

    void identity_is_right_when_denormals_are_flushed() {
#if defined(__SSE__)
        const unsigned state = _mm_getcsr();
        _mm_setcsr(state | 0x8040);  // flush to zero, denormals are zero
        const std::vector<T> result = rotated<N>(identity, f);
        _mm_setcsr(state);
        EXPECT_LE(distance(result, f), bound(identity) * norm(f));
#endif
    }

    void inverse_after_forward_returns_the_input() {
        for (int k = 0; k < kRotations; ++k) {
            const Matrix R = cases::random_rotation(random);
            const std::vector<T> back = rotated<N>(cases::transposed(R), rotated<N>(R, f));
            EXPECT_LE(distance(back, f), 2 * bound(R) * norm(f));
        }
    }

    void two_rotations_are_their_product() {
        for (int k = 0; k < kRotations; ++k) {
            const Matrix first = cases::random_rotation(random), second = cases::random_rotation(random);
            const Matrix both = cases::rounded_product<T>(second, first);
            const std::vector<T> in_turn = rotated<N>(second, rotated<N>(first, f));
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
            EXPECT_LE(distance(in_turn, rotated<N>(both, f)), limit * norm(f));
        }
    }
};

template <int N>
struct Properties {
    std::mt19937_64 random{N};
    const std::vector<double> f = cases::random_signal(N, random);
    const Matrix rotation = cases::random_rotation(random);

    void x_turns_into_y() {
        // Band 1 is (y, z, x): a quarter turn about z takes the lobe along x to the lobe along y.
        std::vector<double> x(N * N, 0);
        x[3] = 1;
        const auto y = rotated<N>({0, -1, 0, 1, 0, 0, 0, 0, 1}, x);
        EXPECT_NEAR(y[1], 1, tolerance<N>());
        EXPECT_NEAR(y[3], 0, tolerance<N>());
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
        EXPECT_LE(distance(rotated<N>(rotation, p), expected), tolerance<N>() * norm(p));
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
        const auto turned = rotated<N>(rotation, lobe);
        const double nx = rotation[2], ny = rotation[5], nz = rotation[8];
        const double c0 = std::sqrt(std::numbers::pi) / 2, c1 = std::sqrt(std::numbers::pi / 3);
        const double expected[4] = {c0, c1 * ny, c1 * nz, c1 * nx};
        for (int i = 0; i < 4; ++i) EXPECT_NEAR(turned[i], expected[i], tolerance<N>() * norm(lobe));
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
        expect_same_in_place([&](const double* in, double* out) { Order<N>::rotate(r, in, out); });
        expect_same_in_place([&](const double* in, double* out) { Order<N>::rotate_accurate(r, in, out); });
        double scalars[Order<N>::kScalars];
        Order<N>::prepare(r, scalars);
        expect_same_in_place([&](const double* in, double* out) { Order<N>::apply(scalars, in, out); });
    }

    void a_value_that_is_not_finite_stays_in_its_band() {
        expect_bands_apart<N>(
            f, [&](const std::vector<double>& signal) { return rotated<N>(rotation, signal); });
        expect_bands_apart<N>(f, [&](const std::vector<double>& signal) {
            std::vector<double> out(N * N);
            Order<N>::rotate_accurate(rotation.data(), signal.data(), out.data());
            return out;
        });
        expect_bands_apart<N>(f, [&](const std::vector<double>& signal) {
            std::vector<double> scalars(Order<N>::kScalars), out(N * N);
            Order<N>::prepare(rotation.data(), scalars.data());
            Order<N>::apply(scalars.data(), signal.data(), out.data());
            return out;
        });
    }

    void denormals_keep_their_absolute_accuracy() {
        const auto rotate = [](const auto* R, const auto* in, auto* out) { Order<N>::rotate(R, in, out); };
        const auto accurate = [](const auto* R, const auto* in, auto* out) {
            Order<N>::rotate_accurate(R, in, out);
        };
        expect_denormals_within_4_n_squared<N, float>(rotation, f, rotate);
        expect_denormals_within_4_n_squared<N, double>(rotation, f, rotate);
        expect_denormals_within_4_n_squared<N, float>(rotation, f, accurate);
        expect_denormals_within_4_n_squared<N, double>(rotation, f, accurate);
    }

    void energy_of_every_band_survives_a_chain_of_small_rotations() {
        // 10^6 steps of one vector; n steps may lose n times the contract, orthonormality of the step
        // included.
        constexpr int kSteps = 1000000;
        std::vector<double> v = f;
        const Matrix step = cases::about_axis({2.0 / 7, 3.0 / 7, 6.0 / 7}, 1e-3);
        for (int k = 0; k < kSteps; ++k) Order<N>::rotate(step.data(), v.data(), v.data());
        oracle::Matrix3 given;
        std::copy(step.begin(), step.end(), given.begin());
        const double lost = kSteps * (accuracy::contract("rotate", N, false) +
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
        Order<N>::rotate(rotation.data(), rgb.data(), out.data());
        // A value of several channels takes another kernel than one vector does: equal but for rounding.
        std::vector<double> red, green, blue;
        for (const Rgb<double>& value : out) {
            red.push_back(value.r);
            green.push_back(value.g);
            blue.push_back(value.b);
        }
        EXPECT_LE(distance(red, rotated<N>(rotation, f)), tolerance<N>() * norm(f));
        EXPECT_LE(distance(green, rotated<N>(rotation, g)), tolerance<N>() * norm(g));
        EXPECT_LE(distance(blue, rotated<N>(rotation, b)), tolerance<N>() * norm(b));
    }

    void dense_blocks_and_prepared_scalars_turn_as_rotate_does() {
        const std::vector<double> expected = rotated<N>(rotation, f);
        std::vector<double> dense(N * (4 * N * N - 1) / 3), product(N * N, 0), applied(N * N);
        Order<N>::blocks(rotation.data(), dense.data());
        const double* entry = dense.data();
        for (int l = 0; l < N; ++l)
            for (int i = l * l; i < (l + 1) * (l + 1); ++i)
                for (int j = l * l; j < (l + 1) * (l + 1); ++j) product[i] += *entry++ * f[j];
        EXPECT_LE(distance(product, expected), tolerance<N>() * norm(f));
        double scalars[Order<N>::kScalars];
        Order<N>::prepare(rotation.data(), scalars);
        Order<N>::apply(scalars, f.data(), applied.data());
        EXPECT_LE(distance(applied, expected), tolerance<N>() * norm(f));
    }

    template <class Run>
    void expect_mirrors_taken(Run run) {
        Matrix mirror = rotation;
        for (double& entry : mirror) entry = -entry;
        std::vector<double> out(N * N), expected = rotated<N>(rotation, f);
        run(mirror.data(), f.data(), out.data());
        for (int l = 1; l < N; l += 2)
            for (int i = l * l; i < (l + 1) * (l + 1); ++i) expected[i] = -expected[i];
        EXPECT_LE(distance(out, expected), tolerance<N>() * norm(f));
    }
    void the_accurate_kernel_takes_mirrors() {
        expect_mirrors_taken(
            [](const double* r, const double* in, double* out) { Order<N>::rotate_accurate(r, in, out); });
    }
};

/// What `rotate_polynomial` must do.
template <int N>
struct PolynomialProperties : Properties<N> {
    static void run(const double* r, const double* in, double* out) {
        PolynomialOrder<N>::rotate(r, in, out);
    }
    std::vector<double> turned(const std::vector<double>& signal) const {
        std::vector<double> out(N * N);
        run(this->rotation.data(), signal.data(), out.data());
        return out;
    }

    void it_turns_as_rotate_does() {
        EXPECT_LE(distance(turned(this->f), rotated<N>(this->rotation, this->f)),
                  tolerance<N>() * norm(this->f));
    }
    void it_may_overwrite_its_input() {
        this->expect_same_in_place(
            [&](const double* in, double* out) { run(this->rotation.data(), in, out); });
    }
    void it_keeps_a_value_that_is_not_finite_in_its_band() {
        expect_bands_apart<N>(this->f, [&](const std::vector<double>& signal) { return turned(signal); });
    }
    void it_takes_mirrors() { this->expect_mirrors_taken(run); }
};

template <int N>
double lobe_tolerance() {
    return 2 * accuracy::contract("rotate_zhf", N, false);
}

/// What the lobe kernels of a variant must do.
template <class Kernels>
struct LobeProperties {
    static constexpr int N = Kernels::kOrder;
    std::mt19937_64 random{N};
    const std::vector<double> f = cases::random_signal(N, random);
    const Matrix rotation = cases::random_rotation(random);

    static std::vector<double> directions_at(const Matrix& R) {
        std::vector<double> directions(3 * Kernels::kDirections);
        Kernels::lobes(R.data(), directions.data());
        return directions;
    }
    static std::vector<double> still_directions() { return directions_at({1, 0, 0, 0, 1, 0, 0, 0, 1}); }

    void factorize_and_expand_undo_each_other() {
        std::vector<double> z(Kernels::kWeights), back(N * N);
        Kernels::factorize(f.data(), z.data());
        Kernels::expand(z.data(), back.data());
        EXPECT_LE(distance(back, f), lobe_tolerance<N>() * norm(f));
    }

    void weights_of_the_lobes_sum_to_the_signal() {
        // f(ω) = sum over bands and lobes of z_ld * sum_m y_lm(ω_d) y_lm(ω), by the oracle's basis.
        std::vector<double> z(Kernels::kWeights);
        Kernels::factorize(f.data(), z.data());
        const std::vector<double> directions = still_directions();
        std::vector<double> sum(N * N, 0);
        for (int l = 0; l < N; ++l) {
            for (int d = 0; d < Kernels::count(l); ++d) {
                const double* at = &directions[3 * Kernels::direction(l, d)];
                const auto y = oracle::basis(N, {at[0], at[1], at[2]});
                for (int i = l * l; i < (l + 1) * (l + 1); ++i)
                    sum[i] += z[Kernels::weight(l, d)] * static_cast<double>(y[i]);
            }
        }
        EXPECT_LE(distance(sum, f), lobe_tolerance<N>() * norm(f));
    }

    void turned_lobes_are_r_times_those_of_the_identity() {
        const std::vector<double> still = still_directions(), turned = directions_at(rotation);
        for (int d = 0; d < Kernels::kDirections; ++d) {
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
        std::vector<double> samples(Kernels::kWeights), out(N * N);
        for (int l = 0; l < N; ++l) {
            for (int d = 0; d < Kernels::count(l); ++d) {
                oracle::Vector3 back{};
                for (int i = 0; i < 3; ++i)
                    for (int j = 0; j < 3; ++j)
                        back[i] += rotation[3 * j + i] * directions[3 * Kernels::direction(l, d) + j];
                const auto y = oracle::basis(N, back);
                oracle::Real sample = 0;
                for (int i = l * l; i < (l + 1) * (l + 1); ++i) sample += f[i] * y[i];
                samples[Kernels::weight(l, d)] = static_cast<double>(sample);
            }
        }
        Kernels::resample(samples.data(), out.data());
        EXPECT_LE(distance(out, rotated<N>(rotation, f)), lobe_tolerance<N>() * norm(f));
    }

    /// Arrays as long as the longer of input and output, so that one may be the other.
    template <class Run>
    void expect_same_in_place(Run run) {
        std::vector<double> in(Kernels::kWeights, 0.0), apart(Kernels::kWeights, 0.0);
        for (double& value : in) value = std::uniform_real_distribution(-1.0, 1.0)(random);
        std::vector<double> in_place = in;
        run(in.data(), apart.data());
        run(in_place.data(), in_place.data());
        for (int i = 0; i < N * N; ++i) EXPECT_EQ(apart[i], in_place[i]);
    }
    void products_may_overwrite_their_input() {
        expect_same_in_place([](const double* in, double* out) { Kernels::factorize(in, out); });
        expect_same_in_place([](const double* in, double* out) { Kernels::expand(in, out); });
        expect_same_in_place([](const double* in, double* out) { Kernels::resample(in, out); });
    }

    void rotate_zhf_may_overwrite_its_input() {
        expect_same_in_place(
            [&](const double* in, double* out) { Kernels::rotate_zhf(rotation.data(), in, out); });
    }

    void rotate_zhf_keeps_a_value_that_is_not_finite_in_its_band() {
        expect_bands_apart<N>(f, [&](const std::vector<double>& signal) {
            std::vector<double> out(N * N);
            Kernels::rotate_zhf(rotation.data(), signal.data(), out.data());
            return out;
        });
    }

    void denormals_keep_their_absolute_accuracy_in_rotate_zhf() {
        const auto zhf = [](const auto* R, const auto* in, auto* out) { Kernels::rotate_zhf(R, in, out); };
        expect_denormals_within_4_n_squared<N, float>(rotation, f, zhf);
        expect_denormals_within_4_n_squared<N, double>(rotation, f, zhf);
    }

    void factorize_keeps_a_value_that_is_not_finite_in_its_band() {
        std::vector<double> spoilt = f, clean(Kernels::kWeights), result(Kernels::kWeights);
        spoilt[1] = std::numeric_limits<double>::quiet_NaN();
        Kernels::factorize(f.data(), clean.data());
        Kernels::factorize(spoilt.data(), result.data());
        for (int i = Kernels::weight(2, 0); i < Kernels::kWeights; ++i) EXPECT_EQ(result[i], clean[i]);
    }

    void factorize_takes_its_constants_in_the_signals_value_type() {
        std::vector<Rgb<double>> rgb(N * N), out(Kernels::kWeights);
        for (int i = 0; i < N * N; ++i) rgb[i] = {f[i], 0, 0};
        std::vector<double> z(Kernels::kWeights);
        Kernels::factorize(rgb.data(), out.data());
        Kernels::factorize(f.data(), z.data());
        for (int i = 0; i < Kernels::kWeights; ++i) EXPECT_EQ(out[i].r, z[i]);
    }
};

std::string text_of(const Tally& tally) {
    return fmt::format("{} mul {} add {} fma {} other", tally.mul, tally.add, tally.fma, tally.other);
}

template <int N>
struct Counts {
    std::vector<Counting> r{9, Counting(0.5)}, in{N * N, Counting(1)}, out{N * N, Counting(0)};

    /// What the counting type sees for one vector is the banner's first part.
    template <class Run>
    void expect_banner(const std::string& kernel, Run run) {
        Counting::tally = {};
        run();
        EXPECT_EQ(text_of(Counting::tally), banner::cost(N, kernel).one) << kernel;
    }

    void banners_tell_what_a_counting_type_sees() {
        std::vector<Counting> dense(N * (4 * N * N - 1) / 3, Counting(0)),
            scalars(Order<N>::kScalars, Counting(0));
        expect_banner("rotate", [&] { Order<N>::rotate(r.data(), in.data(), out.data()); });
        expect_banner("prepare", [&] { Order<N>::prepare(r.data(), scalars.data()); });
        expect_banner("apply", [&] { Order<N>::apply(scalars.data(), in.data(), out.data()); });
        expect_banner("rotate_accurate", [&] { Order<N>::rotate_accurate(r.data(), in.data(), out.data()); });
        expect_banner("blocks", [&] { Order<N>::blocks(r.data(), dense.data()); });
    }

    void a_further_vector_costs_what_the_banner_says() {
        std::vector<PerVector> f(N * N), result(N * N);
        std::vector<double> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
        PerVector::tally = {};
        Order<N>::rotate(rotation.data(), f.data(), result.data());
        const std::string kernel = N == 2 ? "rotate" : "rotate_channels";
        EXPECT_EQ(text_of(PerVector::tally), banner::cost(N, kernel).further);
    }

    /// The numbers the project set itself: multiplications (mul + fma) and instructions of one vector,
    /// instructions of three channels that share a rotation.
    void rotate_costs_no_more_than_its_goal() {
        struct Goal {
            int multiplications, instructions, rgb_instructions;
        };
        const std::map<int, Goal> goals{{3, {43, 44, 124}},   {4, {112, 118, 284}}, {5, {193, 201, 509}},
                                        {6, {303, 311, 812}}, {7, {475, 0, 0}},     {8, {665, 0, 0}},
                                        {9, {905, 0, 0}},     {10, {1200, 0, 0}}};
        if (!goals.contains(N)) return;
        const Goal goal = goals.at(N);
        Counting::tally = {};
        Order<N>::rotate(r.data(), in.data(), out.data());
        EXPECT_LE(Counting::tally.mul + Counting::tally.fma, goal.multiplications);
        if (goal.instructions == 0) return;
        EXPECT_LE(instructions(Counting::tally), goal.instructions);
        std::vector<CountingRgb> rgb(N * N), turned(N * N);
        Counting::tally = {};
        Order<N>::rotate(r.data(), rgb.data(), turned.data());
        EXPECT_LE(instructions(Counting::tally), goal.rgb_instructions);
    }

    static int instructions(const Tally& t) { return t.mul + t.add + t.fma + t.other; }

    /// Three counting channels.
    struct CountingRgb {
        Counting c[3];
        template <class Each>
        static CountingRgb of(Each each) {
            CountingRgb result;
            for (int k = 0; k < 3; ++k) result.c[k] = each(k);
            return result;
        }
        friend CountingRgb operator+(const CountingRgb& a, const CountingRgb& b) {
            return of([&](int k) { return a.c[k] + b.c[k]; });
        }
        friend CountingRgb operator-(const CountingRgb& a, const CountingRgb& b) {
            return of([&](int k) { return a.c[k] - b.c[k]; });
        }
        friend CountingRgb operator-(const CountingRgb& a) {
            return of([&](int k) { return -a.c[k]; });
        }
        friend CountingRgb operator*(Counting s, const CountingRgb& a) {
            return of([&](int k) { return s * a.c[k]; });
        }
        friend CountingRgb fma(Counting s, const CountingRgb& a, const CountingRgb& b) {
            return of([&](int k) { return fma(s, a.c[k], b.c[k]); });
        }
    };

    /// A signal value that counts what is done with it; its scalars are doubles and are not counted.
    struct PerVector {
        static inline Tally tally;
        friend PerVector operator+(PerVector, PerVector) { return ++tally.add, PerVector{}; }
        friend PerVector operator-(PerVector, PerVector) { return ++tally.add, PerVector{}; }
        friend PerVector operator-(PerVector) { return {}; }
        friend PerVector operator*(double, PerVector) { return ++tally.mul, PerVector{}; }
        friend PerVector fma(double, PerVector, PerVector) { return ++tally.fma, PerVector{}; }
    };
};

template <int N>
struct PolynomialCounts : Counts<N> {
    void the_banner_tells_what_a_counting_type_sees() {
        this->expect_banner("rotate_polynomial", [&] {
            PolynomialOrder<N>::rotate(this->r.data(), this->in.data(), this->out.data());
        });
    }

    void it_neither_divides_nor_takes_a_root() {
        Counting::tally = {};
        PolynomialOrder<N>::rotate(this->r.data(), this->in.data(), this->out.data());
        EXPECT_GT(Counting::tally.fma, 0);
        EXPECT_EQ(Counting::tally.other, 0);
    }

    void a_further_vector_costs_what_the_banner_says() {
        using Value = typename Counts<N>::PerVector;
        std::vector<Value> f(N * N), result(N * N);
        const std::vector<double> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
        Value::tally = {};
        PolynomialOrder<N>::rotate(rotation.data(), f.data(), result.data());
        EXPECT_EQ(text_of(Value::tally), banner::cost(N, "rotate_polynomial").further);
    }
};

template <class Kernels>
struct LobeCounts {
    static constexpr int N = Kernels::kOrder;
    std::vector<Counting> r{9, Counting(0.5)}, in{Kernels::kWeights, Counting(1)},
        out{Kernels::kWeights, Counting(0)};

    template <class Run>
    void expect_banner(const std::string& kernel, Run run) {
        Counting::tally = {};
        run();
        EXPECT_EQ(text_of(Counting::tally), banner::cost(N, Kernels::kPrefix + kernel).one) << kernel;
    }

    void banners_tell_what_a_counting_type_sees_in_products() {
        std::vector<Counting> directions(3 * Kernels::kDirections, Counting(0));
        expect_banner("factorize", [&] { Kernels::factorize(in.data(), out.data()); });
        expect_banner("expand", [&] { Kernels::expand(in.data(), out.data()); });
        expect_banner("resample", [&] { Kernels::resample(in.data(), out.data()); });
        expect_banner("lobes", [&] { Kernels::lobes(r.data(), directions.data()); });
    }

    void banners_tell_what_a_counting_type_sees_in_rotate_zhf() {
        expect_banner("rotate_zhf", [&] { Kernels::rotate_zhf(r.data(), in.data(), out.data()); });
    }

    /// Below the paper's Table II, standard algorithm on the CPU, although the turning of the lobes is
    /// counted.
    void rotate_zhf_multiplies_less_than_the_paper() {
        const std::map<int, int> paper{{3, 90},   {4, 275},  {5, 606},  {6, 1123},
                                       {7, 1891}, {8, 2930}, {9, 4297}, {10, 6046}};
        if (!paper.contains(N)) return;
        Counting::tally = {};
        Kernels::rotate_zhf(r.data(), in.data(), out.data());
        EXPECT_LT(Counting::tally.mul + Counting::tally.fma, paper.at(N));
    }
};

/// Runs one check for every order that is compiled in, or that has lobes.
#define ZONAL_CHECK_ORDER(N)                     \
    {                                            \
        SCOPED_TRACE("order " #N);               \
        check(std::integral_constant<int, N>{}); \
    }
template <class Check>
void for_each_order(Check check) {
    ZONAL_FOR_EACH_ORDER(ZONAL_CHECK_ORDER)
}
template <class Check>
void for_each_lobe_order(Check check) {
    ZONAL_FOR_EACH_LOBE_ORDER(ZONAL_CHECK_ORDER)
}
template <class Check>
void for_each_per_band_order(Check check) {
    ZONAL_FOR_EACH_PER_BAND_ORDER(ZONAL_CHECK_ORDER)
}
template <class Check>
void for_each_polynomial_order([[maybe_unused]] Check check) {
    ZONAL_FOR_EACH_POLYNOMIAL_ORDER(ZONAL_CHECK_ORDER)
}
#undef ZONAL_CHECK_ORDER

#define ZONAL_TEST(suite, name)                                                     \
    TEST(suite, name) {                                                             \
        for_each_order([](auto order) { suite<decltype(order)::value>{}.name(); }); \
    }
#define ZONAL_TYPED_TEST(suite, name)                                                       \
    TEST(suite, name##_in_float) {                                                          \
        for_each_order([](auto order) { suite<decltype(order)::value, float>{}.name(); });  \
    }                                                                                       \
    TEST(suite, name##_in_double) {                                                         \
        for_each_order([](auto order) { suite<decltype(order)::value, double>{}.name(); }); \
    }
#define ZONAL_POLYNOMIAL_TEST(suite, name)                                                     \
    TEST(suite, name) {                                                                        \
        for_each_polynomial_order([](auto order) { suite<decltype(order)::value>{}.name(); }); \
    }
/// For shared lobes and for the ring.
#define ZONAL_LOBE_TEST(suite, name)                             \
    TEST(suite, name) {                                          \
        for_each_lobe_order([](auto order) {                     \
            suite<LobeOrder<decltype(order)::value>>{}.name();   \
            suite<StableOrder<decltype(order)::value>>{}.name(); \
        });                                                      \
    }
/// For these and for lobes of each band's own.
#define ZONAL_PRODUCT_TEST(suite, name)                                                                    \
    ZONAL_LOBE_TEST(suite, name)                                                                           \
    TEST(PerBand##suite, name) {                                                                           \
        for_each_per_band_order([](auto order) { suite<PerBandOrder<decltype(order)::value>>{}.name(); }); \
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
ZONAL_TEST(Counts, banners_tell_what_a_counting_type_sees)
ZONAL_TEST(Counts, a_further_vector_costs_what_the_banner_says)
ZONAL_TEST(Counts, rotate_costs_no_more_than_its_goal)
ZONAL_POLYNOMIAL_TEST(PolynomialProperties, it_turns_as_rotate_does)
ZONAL_POLYNOMIAL_TEST(PolynomialProperties, it_may_overwrite_its_input)
ZONAL_POLYNOMIAL_TEST(PolynomialProperties, it_keeps_a_value_that_is_not_finite_in_its_band)
ZONAL_POLYNOMIAL_TEST(PolynomialProperties, it_takes_mirrors)
ZONAL_POLYNOMIAL_TEST(PolynomialCounts, the_banner_tells_what_a_counting_type_sees)
ZONAL_POLYNOMIAL_TEST(PolynomialCounts, it_neither_divides_nor_takes_a_root)
ZONAL_POLYNOMIAL_TEST(PolynomialCounts, a_further_vector_costs_what_the_banner_says)
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
ZONAL_PRODUCT_TEST(LobeCounts, banners_tell_what_a_counting_type_sees_in_products)
ZONAL_LOBE_TEST(LobeCounts, banners_tell_what_a_counting_type_sees_in_rotate_zhf)
TEST(LobeCounts, rotate_zhf_multiplies_less_than_the_paper) {
    for_each_lobe_order([](auto order) {
        LobeCounts<LobeOrder<decltype(order)::value>>{}.rotate_zhf_multiplies_less_than_the_paper();
    });
}
#undef ZONAL_TEST
#undef ZONAL_TYPED_TEST
#undef ZONAL_POLYNOMIAL_TEST
#undef ZONAL_LOBE_TEST
#undef ZONAL_PRODUCT_TEST

}  // namespace
}  // namespace zonal
