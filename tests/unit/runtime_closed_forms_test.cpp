#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "support/oracle.hpp"
#include "zonal/basis.hpp"
#include "zonal/closed_forms.hpp"
#include "zonal/eigen.hpp"
#include "zonal/error.hpp"

namespace {

using zonal::Rgb;
using Vector = Eigen::Vector3d;
using Values = std::vector<double>;

constexpr double kPi = std::numbers::pi;
constexpr int kMaxOrder = 20;

/// A basis value of band l is below 2 and carries about 6 l roundings; sums of up to 400 products of them
/// with coefficients below 3 are judged: 400 * 6 * 19 * 1.1e-16 * 2 at worst, 1e-11, and far less in the
/// mean.
constexpr double kTolerance = 1e-12;

std::vector<Vector> directions() {
    std::vector<Vector> result;
    for (const auto& [x, y, z] : {std::array{0.3, 0.5, 0.7},
                                  {-0.9, 0.2, -0.1},
                                  {0.2, -0.8, 0.4},
                                  {1e-9, 2e-9, 1.0},
                                  {0.0, 0.0, -1.0},
                                  {1.0, 0.0, 0.0}}) {
        result.push_back(Vector(x, y, z).normalized());
    }
    return result;
}

/// Unequal in every coefficient, so that no exchange of axes or sign cancels.
Values asymmetric_signal(int order) {
    Values signal(order * order);
    for (std::size_t i = 0; i < signal.size(); ++i) signal[i] = std::sin(1.7 * static_cast<double>(i) + 0.4);
    return signal;
}

/// The integral of max(0, n . w) f(w): Gauss's rule of 5 nodes in t = n . w on 40 parts of [0, 1] and 64
/// equal steps about n. Exact to rounding: about n a polynomial of degree below 20 has no wave above 19, and
/// what is left of f once averaged is a polynomial in t of degree below 20, over parts of length 1 / 40.
double cosine_weighted_integral(const Vector& n, const std::function<double(const Vector&)>& f) {
    constexpr int kParts = 40, kSteps = 64;
    const double inner = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3;
    const double outer = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
    const double inner_weight = (322 + 13 * std::sqrt(70.0)) / 900;
    const double outer_weight = (322 - 13 * std::sqrt(70.0)) / 900;
    const std::array<std::array<double, 2>, 5> rule = {{{0, 128.0 / 225},
                                                        {inner, inner_weight},
                                                        {-inner, inner_weight},
                                                        {outer, outer_weight},
                                                        {-outer, outer_weight}}};
    const Vector u = n.unitOrthogonal(), v = n.cross(u);
    double sum = 0;
    for (int part = 0; part < kParts; ++part) {
        for (const auto& [node, weight] : rule) {
            const double t = (part + 0.5 + node / 2) / kParts, s = std::sqrt(1 - t * t);
            for (int step = 0; step < kSteps; ++step) {
                const double phi = 2 * kPi * step / kSteps;
                const Vector w = t * n + s * std::cos(phi) * u + s * std::sin(phi) * v;
                sum += weight / (2 * kParts) * (2 * kPi / kSteps) * t * f(w);
            }
        }
    }
    return sum;
}

double oracle_value(int order, const Values& f, const Vector& w) {
    const std::vector<zonal::oracle::Real> coefficients(f.begin(), f.end());
    return static_cast<double>(zonal::oracle::evaluate(order, coefficients, {w.x(), w.y(), w.z()}));
}

TEST(runtime_closed_forms, turned_zonal_signal_is_the_function_about_the_new_axis) {
    Values zonal(kMaxOrder);
    for (int l = 0; l < kMaxOrder; ++l) zonal[l] = (l % 3 - 0.8) / (l + 1);
    for (const int order : {1, 2, 5, kMaxOrder}) {
        for (const Vector& axis : directions()) {
            Values out(order * order);
            zonal::turn_zonal(order, std::span(zonal).first(order), axis, out);
            for (const Vector& w : directions()) {
                double wanted = 0;
                for (int l = 0; l < order; ++l) {
                    const double cosine = std::clamp(axis.dot(w), -1.0, 1.0);
                    wanted += zonal[l] * std::sqrt((2 * l + 1) / (4 * kPi)) * std::legendre(l, cosine);
                }
                EXPECT_NEAR(oracle_value(order, out, w), wanted, kTolerance) << "order " << order;
            }
        }
    }
}

TEST(runtime_closed_forms, turning_onto_z_gives_the_zonal_coefficients_back) {
    const Values zonal = {0.3, -1.2, 2.5};
    Values out(9);
    zonal::turn_zonal(3, zonal, Vector::UnitZ(), out);
    const Values wanted = {0.3, 0, -1.2, 0, 0, 0, 2.5, 0, 0};
    for (std::size_t i = 0; i < out.size(); ++i)
        EXPECT_NEAR(out[i], wanted[i], 16 * std::numeric_limits<double>::epsilon());
}

TEST(runtime_closed_forms, turned_zonal_signal_may_lie_where_its_coefficients_lay) {
    Values storage = {0.3, -1.2, 2.5, 0, 0, 0, 0, 0, 0}, wanted(9);
    const Vector axis = directions().front();
    zonal::turn_zonal(3, Values{0.3, -1.2, 2.5}, axis, wanted);
    zonal::turn_zonal(3, std::span<const double>(storage).first(3), axis, storage);
    EXPECT_EQ(storage, wanted);
}

TEST(runtime_closed_forms, clamped_cosine_factors_are_those_of_the_literature) {
    // Ramamoorthi and Hanrahan 2001, the factors they write with a hat.
    const Values wanted = {kPi, 2 * kPi / 3, kPi / 4, 0, -kPi / 24, 0, kPi / 64, 0, -kPi / 128};
    for (int l = 0; l < static_cast<int>(wanted.size()); ++l) {
        EXPECT_NEAR(zonal::clamped_cosine_factor(l), wanted[l],
                    2 * l * std::numeric_limits<double>::epsilon() * std::abs(wanted[l]))
            << "l = " << l;
    }
}

TEST(runtime_closed_forms, clamped_cosine_factors_are_the_integrals_they_claim_to_be) {
    for (int l = 0; l < kMaxOrder; ++l) {
        const double integral = cosine_weighted_integral(
            Vector::UnitZ(), [&](const Vector& w) { return std::legendre(l, w.z()); });
        EXPECT_NEAR(zonal::clamped_cosine_factor(l), integral, kTolerance) << "l = " << l;
    }
}

TEST(runtime_closed_forms, clamped_cosine_of_order_2_is_kirschs) {
    // His basis has the Condon-Shortley sign: x and y, of odd m, change it.
    const Vector n = directions().front();
    Values out(4);
    zonal::clamped_cosine(2, n, out);
    EXPECT_NEAR(out[0], std::sqrt(kPi) / 2, kTolerance);
    EXPECT_NEAR(out[1], std::sqrt(kPi / 3) * n.y(), kTolerance);
    EXPECT_NEAR(out[2], std::sqrt(kPi / 3) * n.z(), kTolerance);
    EXPECT_NEAR(out[3], std::sqrt(kPi / 3) * n.x(), kTolerance);
}

TEST(runtime_closed_forms, clamped_cosine_is_the_projection_of_its_definition) {
    const int order = 7;
    for (const Vector& n : directions()) {
        Values out(order * order);
        zonal::clamped_cosine(order, n, out);
        for (int i = 0; i < order * order; ++i) {
            Values basis_function(order * order);
            basis_function[i] = 1;
            const double wanted = cosine_weighted_integral(
                n, [&](const Vector& w) { return zonal::evaluate(order, basis_function, w); });
            EXPECT_NEAR(out[i], wanted, kTolerance) << "index " << i << ", n = " << n.transpose();
        }
    }
}

TEST(runtime_closed_forms, irradiance_is_the_integral_over_the_hemisphere) {
    for (const int order : {1, 2, 3, 6, 10}) {
        const Values radiance = asymmetric_signal(order);
        Values out(radiance.size());
        zonal::irradiance(order, radiance, out);
        for (const Vector& n : directions()) {
            const double wanted = cosine_weighted_integral(
                n, [&](const Vector& w) { return zonal::evaluate(order, radiance, w); });
            EXPECT_NEAR(oracle_value(order, out, n), wanted, 10 * kTolerance) << "order " << order;
        }
    }
}

TEST(runtime_closed_forms, irradiance_works_in_place_and_in_colour) {
    const int order = 4;
    const Values radiance = asymmetric_signal(order);
    Values wanted(radiance.size()), same = radiance;
    zonal::irradiance(order, radiance, wanted);
    zonal::irradiance(order, same, same);
    EXPECT_EQ(same, wanted);
    std::vector<Rgb<double>> colour;
    for (const double value : radiance) colour.push_back({value, -2 * value, 4 * value});
    zonal::irradiance(order, colour, colour);
    for (std::size_t i = 0; i < colour.size(); ++i)
        EXPECT_EQ(colour[i], (Rgb<double>{wanted[i], -2 * wanted[i], 4 * wanted[i]}));
}

TEST(runtime_closed_forms, linear_lobe_is_band_1) {
    const Values signal = asymmetric_signal(3);
    const zonal::LinearLobe lobe = zonal::linear_lobe(3, signal);
    EXPECT_NEAR(zonal::to_eigen(lobe.direction).norm(), 1, 4 * std::numeric_limits<double>::epsilon());
    for (const Vector& w : directions()) {
        const double wanted =
            std::sqrt(3 / (4 * kPi)) * (signal[1] * w.y() + signal[2] * w.z() + signal[3] * w.x());
        EXPECT_NEAR(lobe.coefficient * std::sqrt(3 / (4 * kPi)) * zonal::to_eigen(lobe.direction).dot(w),
                    wanted, kTolerance);
    }
}

TEST(runtime_closed_forms, linear_lobe_of_nothing_points_up_and_is_dark) {
    const zonal::LinearLobe lobe = zonal::linear_lobe(2, Values{5, 0, 0, 0});
    EXPECT_EQ(lobe.direction, Vector(0, 0, 1));
    EXPECT_EQ(lobe.coefficient, 0);
}

TEST(runtime_closed_forms, linear_lobe_of_tiny_and_huge_bands_keeps_its_direction) {
    for (const double scale : {1e-320, 1e-200, 1e200}) {
        // A denormal of 1e-320 has 11 bits.
        const double tolerance = scale < 1e-300 ? 1e-3 : 4 * std::numeric_limits<double>::epsilon();
        const zonal::LinearLobe lobe = zonal::linear_lobe(2, Values{0, 3 * scale, 0, 4 * scale});
        EXPECT_NEAR((zonal::to_eigen(lobe.direction) - Vector(0.8, 0.6, 0)).norm(), 0, tolerance) << scale;
    }
}

TEST(runtime_closed_forms, dominant_light_of_a_light_is_that_light) {
    const int order = 5;
    for (const Vector& d : directions()) {
        Values signal(order * order);
        zonal::evaluate_basis(order, d, signal);
        for (double& value : signal) value *= 2.5;
        const auto light = zonal::dominant_light(order, signal);
        EXPECT_NEAR((zonal::to_eigen(light.direction) - d).norm(), 0, kTolerance);
        EXPECT_NEAR(light.intensity, 2.5, kTolerance);
    }
}

TEST(runtime_closed_forms, dominant_light_has_the_intensity_of_least_squares) {
    const int order = 4;
    const Values signal = asymmetric_signal(order);
    const auto light = zonal::dominant_light(order, signal);
    Values unit(signal.size());
    zonal::evaluate_basis(order, light.direction, unit);
    double projected = 0, squared = 0;  // <f - c y, y> = 0
    for (std::size_t i = 0; i < signal.size(); ++i) {
        projected += signal[i] * unit[i];
        squared += unit[i] * unit[i];
    }
    EXPECT_NEAR(light.intensity, projected / squared, kTolerance);
    EXPECT_GT(Vector(signal[3], signal[1], signal[2]).dot(zonal::to_eigen(light.direction)), 0);
}

TEST(runtime_closed_forms, dominant_light_in_colour_points_along_luminance) {
    const int order = 3;
    const Values signal = asymmetric_signal(order), other = [] {
        Values reversed = asymmetric_signal(3);
        std::ranges::reverse(reversed);
        return reversed;
    }();
    std::vector<Rgb<double>> colour;
    Values luminance;
    for (std::size_t i = 0; i < signal.size(); ++i) {
        colour.push_back({signal[i], other[i], signal[i] - 2 * other[i]});
        luminance.push_back(0.2126 * colour[i].r + 0.7152 * colour[i].g + 0.0722 * colour[i].b);
    }
    const auto light = zonal::dominant_light(order, colour);
    const auto grey = zonal::dominant_light(order, luminance);
    EXPECT_NEAR((zonal::to_eigen(light.direction) - zonal::to_eigen(grey.direction)).norm(), 0, kTolerance);
    const auto& c = light.intensity;
    EXPECT_NEAR(0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b, grey.intensity, kTolerance);
    EXPECT_NEAR(c.b, c.r - 2 * c.g, kTolerance);
}

std::string message_of(const std::function<void()>& call) {
    try {
        call();
    } catch (const zonal::Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(runtime_closed_forms, mistakes_are_named) {
    Values one(1), nine(9), ten(10);
    const auto expect_message = [](const char* part, const std::function<void()>& call) {
        const std::string message = message_of(call);
        EXPECT_NE(message.find(part), std::string::npos) << message;
    };
    expect_message("length of zonal for order 3: found 10, wanted 3;",
                   [&] { zonal::turn_zonal(3, ten, Vector::UnitZ(), nine); });
    expect_message("length of out for order 3: found 10, wanted 9;",
                   [&] { zonal::turn_zonal(3, std::span(nine).first(3), Vector::UnitZ(), ten); });
    expect_message("order: found 21, wanted 1 to 20;", [&] { zonal::irradiance(21, nine, nine); });
    expect_message("length of in for order 3: found 10, wanted 9;", [&] { zonal::irradiance(3, ten, nine); });
    expect_message("band: found -1, wanted at least 0;", [] { zonal::clamped_cosine_factor(-1); });
    expect_message("order: found 1, wanted 2 to 20;", [&] { zonal::linear_lobe(1, one); });
    expect_message("order: found 1, wanted 2 to 20;", [&] { zonal::dominant_light(1, one); });
    expect_message("length of signal for order 3: found 10, wanted 9;",
                   [&] { zonal::dominant_light(3, ten); });
}

}  // namespace
