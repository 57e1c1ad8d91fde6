// Closed forms for functions symmetric about an axis, clamped-cosine light and band 1.
//
// Factors of the clamped cosine: A_l = 2 pi times the integral of t P_l(t) over [0, 1]. Beyond A_1 = 2 pi / 3
// the odd ones vanish; the even ones follow from A_0 = pi by A_l = -A_{l-2} (l - 3) / (l + 2), the ratio of
// the closed form 2 pi (-1)^(l/2-1) l! / ((l+2) (l-1) 2^l (l/2)!^2).
//
// Light: sum over lm of y_l^m(d)^2 = order^2 / 4 pi, so the best multiple of y(d) is 4 pi f(d) / order^2.
//
// Sources: zonal/closed_forms.hpp.

#include "zonal/closed_forms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/checks.hpp"
#include "core/text.hpp"
#include "zonal/basis.hpp"
#include "zonal/error.hpp"

namespace zonal {
namespace {

using std::numbers::pi;

using Bands = std::array<double, kMaxOrder>;

Bands clamped_cosine_factors() {
    Bands factors;
    for (int l = 0; l < kMaxOrder; ++l) factors[l] = clamped_cosine_factor(l);
    return factors;
}

template <class V>
void scale_bands(int order, const Bands& factors, std::span<const V> in, std::span<V> out) {
    for (int l = 0; l < order; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i) out[i] = factors[l] * in[i];
}

template <class V>
void convolve_with_clamped_cosine(int order, std::span<const V> in, std::span<V> out) {
    check_order(order);
    check_length("in", order, in.size());
    check_length("out", order, out.size());
    scale_bands(order, clamped_cosine_factors(), in, out);
}

void check_band_1(int order, std::size_t length) {
    check_order(order);
    check_length("signal", order, length);
    if (order >= 2) return;
    throw Error({.field = "order",
                 .found = text_of(order),
                 .wanted = joined("2 to ", kMaxOrder),
                 .next_step = "a direction needs band 1"});
}

LinearLobe lobe_of_band_1(double y, double z, double x) {
    const double scale =
        std::max({std::abs(x), std::abs(y), std::abs(z)});  // no square may under- or overflow
    if (scale == 0) return {Direction(0, 0, 1), 0};
    const double u = x / scale, v = y / scale, w = z / scale;
    const double norm = std::sqrt(u * u + v * v + w * w);
    return {Direction(u / norm, v / norm, w / norm), scale * norm};
}

double luminance(const Rgb<double>& colour) {
    return 0.2126 * colour.r + 0.7152 * colour.g + 0.0722 * colour.b;  // ITU-R BT.709
}

double light_scale(int order) { return 4 * pi / (order * order); }

}  // namespace

void turn_zonal(int order, std::span<const double> zonal, const Direction& direction, std::span<double> out) {
    check_order(order);
    check_length("out", order, out.size());
    if (zonal.size() != static_cast<std::size_t>(order)) {
        throw Error({.field = joined("length of zonal for order ", order),
                     .found = text_of(zonal.size()),
                     .wanted = text_of(order),
                     .next_step = "pass one zonal coefficient a band"});
    }
    Bands factors;
    for (int l = 0; l < order; ++l) factors[l] = std::sqrt(4 * pi / (2 * l + 1)) * zonal[l];
    evaluate_basis(order, direction, out);
    scale_bands(order, factors, std::span<const double>(out), out);
}

double clamped_cosine_factor(int l) {
    if (l < 0) {
        throw Error({.field = "band",
                     .found = text_of(l),
                     .wanted = "at least 0",
                     .next_step = "choose a band of the signal"});
    }
    if (l == 1) return 2 * pi / 3;
    if (l % 2 == 1) return 0;
    double factor = pi;
    for (int k = 2; k <= l; k += 2) factor *= (3.0 - k) / (k + 2.0);
    return factor;
}

void clamped_cosine(int order, const Direction& direction, std::span<double> out) {
    evaluate_basis(order, direction, out);
    irradiance(order, out, out);
}

void irradiance(int order, std::span<const double> in, std::span<double> out) {
    convolve_with_clamped_cosine(order, in, out);
}

void irradiance(int order, std::span<const Rgb<double>> in, std::span<Rgb<double>> out) {
    convolve_with_clamped_cosine(order, in, out);
}

LinearLobe linear_lobe(int order, std::span<const double> signal) {
    check_band_1(order, signal.size());
    return lobe_of_band_1(signal[1], signal[2], signal[3]);
}

DirectionalLight<double> dominant_light(int order, std::span<const double> signal) {
    const Direction direction = linear_lobe(order, signal).direction;
    return {direction, light_scale(order) * evaluate(order, signal, direction)};
}

DirectionalLight<Rgb<double>> dominant_light(int order, std::span<const Rgb<double>> signal) {
    check_band_1(order, signal.size());
    const Direction direction =
        lobe_of_band_1(luminance(signal[1]), luminance(signal[2]), luminance(signal[3])).direction;
    return {direction, light_scale(order) * evaluate(order, signal, direction)};
}

}  // namespace zonal
