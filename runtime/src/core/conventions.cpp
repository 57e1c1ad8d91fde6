// Converts SH vectors and rotations between other libraries' conventions and ours.
//
// A convention is three facts: a signed permutation P of the axes; a place and a scale for each coefficient,
// ours[index_j] = theirs[j] / scale_j; and whether its matrices act on rows. The function is
//     f(w) = g(P w), g(v) = sum over j of ours[index_j] y_{index_j}(v).
//
// The Condon-Shortley sign is P = diag(-1, -1, 1): a half turn about z multiplies e^(i m phi) by (-1)^m.
//
// f(R^T w) = g((P R P^T)^T P w): a kernel turns g by P R P^T, and their coefficients as they lie where
// scale_j is the same all over a band.
//
// Sources: KHR_gaussian_splatting (glTF 2.0 extension), table of constants; DirectXMath, XMSHEvalDirection
// and XMSHRotate; google/spherical-harmonics, EvalSH; Nachbar et al., AmbiX, 2011 (ACN, SN3D); Ambisonia,
// encoding equations (FuMa); Unity manual, Light Probes, technical information; three.js,
// SphericalHarmonics3; e3nn, o3.spherical_harmonics.

#include "zonal/conventions.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "checks.hpp"
#include "colours.hpp"
#include "convention_places.hpp"
#include "text.hpp"
#include "zonal/error.hpp"
#include "zonal/rotate.hpp"

namespace zonal {
namespace {

using std::numbers::pi;

enum class Axes {
    kOurs,
    kHalfTurnAboutZ,  ///< P w = (-x, -y, z)
    kYPolar,          ///< P w = (z, x, y)
};

struct Definition {
    Convention convention;
    std::string_view name;
    Axes axes = Axes::kOurs;
    bool multiplies_rows = false;
    bool is_scaled_within_bands = false;  ///< then max_order is at most kMaxScaledOrder
    int min_order = 1;
    int max_order = kMaxOrder;
};

constexpr int kMaxScaledOrder = 4;

constexpr auto kDefinitions = std::to_array<Definition>({
    {.convention = Convention::kGaussianSplatting, .name = "3dgs", .axes = Axes::kHalfTurnAboutZ},
    {.convention = Convention::kGaussianSplatting,
     .name = "khr_gaussian_splatting",
     .axes = Axes::kHalfTurnAboutZ},
    {.convention = Convention::kDirectX,
     .name = "directx",
     .axes = Axes::kHalfTurnAboutZ,
     .multiplies_rows = true},
    {.convention = Convention::kGoogle, .name = "google", .axes = Axes::kHalfTurnAboutZ},
    {.convention = Convention::kAmbixSn3d, .name = "ambix_sn3d"},
    {.convention = Convention::kAmbixN3d, .name = "ambix_n3d"},
    {.convention = Convention::kFuMa,
     .name = "fuma",
     .is_scaled_within_bands = true,
     .max_order = kMaxScaledOrder},
    {.convention = Convention::kUnityL2,
     .name = "unity_l2",
     .is_scaled_within_bands = true,
     .min_order = 3,
     .max_order = 3},
    {.convention = Convention::kThreeJs, .name = "threejs", .min_order = 3, .max_order = 3},
    {.convention = Convention::kE3nn, .name = "e3nn", .axes = Axes::kYPolar},
});

const Definition& definition_of(Convention convention) {
    const auto found = std::ranges::find(kDefinitions, convention, &Definition::convention);
    if (found != kDefinitions.end()) return *found;
    throw Error({.field = "convention",
                 .found = joined("the number ", static_cast<int>(convention)),
                 .wanted = "one of the enumerators of zonal::Convention",
                 .next_step = "use convention_from_name to read a convention"});
}

void check_has_order(const Definition& definition, int order) {
    if (order >= definition.min_order && order <= definition.max_order) return;
    const bool is_single = definition.min_order == definition.max_order;
    throw Error({.field = joined("order of a signal in the convention ", definition.name),
                 .found = text_of(order),
                 .wanted = is_single ? text_of(definition.min_order)
                                     : joined(definition.min_order, " to ", definition.max_order),
                 .next_step = "choose an order (number of bands) that the convention has"});
}

template <class V>
void check_call(const Definition& definition, int order, std::span<const V> in, std::span<V> out) {
    check_has_order(definition, order);
    check_rotated_length("in", order, in.size());
    check_rotated_length("out", order, out.size());
    check_no_partial_overlap(in, out);
}

struct FuMaChannel {
    int index;
    double over_sn3d;
};

/// W X Y Z, R S T U V, K L M N O P Q in our index, and FuMa over SN3D: maxN's weights, for W 1 / sqrt(2).
std::array<FuMaChannel, kMaxScaledOrder * kMaxScaledOrder> fuma_channels() {
    const double stuv = 2 / std::sqrt(3.0), lm = std::sqrt(45.0 / 32), no = 3 / std::sqrt(5.0);
    const double pq = std::sqrt(8.0 / 5);
    return {{{0, std::sqrt(0.5)},
             {3, 1},
             {1, 1},
             {2, 1},
             {6, 1},
             {7, stuv},
             {5, stuv},
             {8, stuv},
             {4, stuv},
             {12, 1},
             {13, lm},
             {11, lm},
             {14, no},
             {10, no},
             {15, pq},
             {9, pq}}};
}

/// A unit source is y_l^m(d) in our basis and, in SN3D, has W = 1: SN3D over ours.
double sn3d_scale(int l) { return std::sqrt(4 * pi / (2 * l + 1)); }

/// Unity stores the factors of 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2: ours times the basis constants.
double unity_scale(int l, int m) {
    if (l == 0) return std::sqrt(1 / (4 * pi));
    if (l == 1) return std::sqrt(3 / (4 * pi));
    if (m == 0) return std::sqrt(5 / (16 * pi));
    return std::sqrt((m == 2 ? 15 / 4.0 : 15) / (4 * pi));
}

Place place_of(Convention convention, int l, int m) {
    const int index = l * (l + 1) + m;
    switch (convention) {
        case Convention::kGaussianSplatting:
        case Convention::kDirectX:
        case Convention::kGoogle:
            return {index, m % 2 == 0 ? 1.0 : -1.0};
        case Convention::kAmbixSn3d:
            return {index, sn3d_scale(l)};
        case Convention::kAmbixN3d:
            return {index, std::sqrt(4 * pi)};
        case Convention::kFuMa: {
            if (l >= kMaxScaledOrder) return {};
            const FuMaChannel channel = fuma_channels()[index];
            return {channel.index, sn3d_scale(l) * channel.over_sn3d};
        }
        case Convention::kUnityL2:
            return {index, l > 2 ? 1 : unity_scale(l, m)};
        case Convention::kThreeJs:
        case Convention::kE3nn:
            break;
    }
    return {index};
}

using Layout = std::array<Place, kMaxOrder * kMaxOrder>;

Layout make_layout(Convention convention) {
    Layout layout;
    for (int l = 0; l < kMaxOrder; ++l) {
        for (int m = -l; m <= l; ++m) {
            Place& place = layout[l * (l + 1) + m];
            place = place_of(convention, l, m);
            place.inverse = 1 / place.scale;
        }
    }
    return layout;
}

const Layout& layout_of(Convention convention) {
    static const auto layouts = [] {
        std::array<Layout, static_cast<std::size_t>(Convention::kE3nn) + 1> all;
        for (std::size_t i = 0; i < all.size(); ++i) all[i] = make_layout(static_cast<Convention>(i));
        return all;
    }();
    return layouts[static_cast<std::size_t>(convention)];
}

template <class V>
struct ScalarOf {
    using type = V;
};
template <class T>
struct ScalarOf<Rgb<T>> {
    using type = T;
};
template <class V>
using Scalar = typename ScalarOf<V>::type;

/// Room for one signal of a convention that is scaled within bands; only these permute.
template <class V>
using Room = std::array<V, kMaxScaledOrder * kMaxScaledOrder>;

template <class V>
std::span<const V> copied(const Definition& definition, std::span<const V> in, Room<V>& room) {
    if (!definition.is_scaled_within_bands) return in;
    std::ranges::copy(in, room.begin());
    return std::span(room).first(in.size());
}

template <class V>
void to_our_places(const Layout& layout, std::span<const V> theirs, std::span<V> ours) {
    for (std::size_t j = 0; j < theirs.size(); ++j)
        ours[layout[j].index] = static_cast<Scalar<V>>(layout[j].inverse) * theirs[j];
}

template <class V>
void to_their_places(const Layout& layout, std::span<const V> ours, std::span<V> theirs) {
    for (std::size_t j = 0; j < theirs.size(); ++j)
        theirs[j] = static_cast<Scalar<V>>(layout[j].scale) * ours[layout[j].index];
}

/// Row i of P, of determinant +1: its value that is not zero, and the column of that.
struct SignedAxis {
    int column;
    int sign;
};

std::array<SignedAxis, 3> rows_of(Axes axes) {
    switch (axes) {
        case Axes::kHalfTurnAboutZ:
            return {{{0, -1}, {1, -1}, {2, 1}}};
        case Axes::kYPolar:
            return {{{2, 1}, {0, 1}, {1, 1}}};
        case Axes::kOurs:
            break;
    }
    return {{{0, 1}, {1, 1}, {2, 1}}};
}

/// P, or its transpose.
template <class T>
RotationMatrix<T> axes_matrix(Axes axes, bool is_transposed) {
    T values[9] = {};
    const auto rows = rows_of(axes);
    for (int i = 0; i < 3; ++i) {
        const auto [column, sign] = rows[i];
        values[is_transposed ? 3 * column + i : 3 * i + column] = static_cast<T>(sign);
    }
    return RotationMatrix<T>::from_row_major(values);
}

template <class V>
void convert_to_zonal(Convention convention, int order, std::span<const V> in, std::span<V> out) {
    const Definition& definition = definition_of(convention);
    check_call(definition, order, in, out);
    if (definition.axes == Axes::kYPolar)  // f(w) = g(P w): g turned by P^T
        return rotate(order, axes_matrix<Scalar<V>>(definition.axes, true), in, out);
    Room<V> room;
    to_our_places(layout_of(convention), copied(definition, in, room), out);
}

template <class V>
void convert_from_zonal(Convention convention, int order, std::span<const V> in, std::span<V> out) {
    const Definition& definition = definition_of(convention);
    check_call(definition, order, in, out);
    if (definition.axes == Axes::kYPolar)
        return rotate(order, axes_matrix<Scalar<V>>(definition.axes, false), in, out);
    Room<V> room;
    to_their_places(layout_of(convention), copied(definition, in, room), out);
}

template <class T, class V>
void rotate_within(Convention convention, int order, const RotationMatrix<T>& rotation, std::span<const V> in,
                   std::span<V> out) {
    const Definition& definition = definition_of(convention);
    check_call(definition, order, in, out);
    const RotationMatrix<T> turn = kernel_rotation(convention, rotation);
    if (!definition.is_scaled_within_bands) return rotate(order, turn, in, out);
    Room<V> room;
    const std::span<V> ours = std::span(room).first(in.size());
    to_our_places(layout_of(convention), in, ours);
    rotate(order, turn, std::span<const V>(ours), ours);
    to_their_places(layout_of(convention), std::span<const V>(ours), out);
}

}  // namespace

std::span<const Place> places_scaled_within_bands(Convention convention, int order) {
    const Definition& definition = definition_of(convention);
    check_has_order(definition, order);
    if (!definition.is_scaled_within_bands) return {};
    return std::span(layout_of(convention)).first(static_cast<std::size_t>(order) * order);
}

std::vector<std::string_view> convention_names() {
    std::vector<std::string_view> names;
    for (const Definition& definition : kDefinitions) names.push_back(definition.name);
    return names;
}

Convention convention_from_name(std::string_view name) {
    const auto found = std::ranges::find(kDefinitions, name, &Definition::name);
    if (found != kDefinitions.end()) return found->convention;
    throw Error({.field = "convention",
                 .found = joined("'", name, "'"),
                 .wanted = joined("one of: ", list_of(convention_names())),
                 .next_step = "choose the library that wrote the data"});
}

template <class T>
RotationMatrix<T> kernel_rotation(Convention convention, const RotationMatrix<T>& rotation) {
    const Definition& definition = definition_of(convention);
    const auto rows = rows_of(definition.axes);
    T values[9];
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            const int row = rows[i].column, column = rows[j].column;
            const T value = definition.multiplies_rows ? rotation(column, row) : rotation(row, column);
            values[3 * i + j] = static_cast<T>(rows[i].sign * rows[j].sign) * value;
        }
    }
    return RotationMatrix<T>::from_row_major(values);
}
template RotationMatrix<float> kernel_rotation(Convention, const RotationMatrix<float>&);
template RotationMatrix<double> kernel_rotation(Convention, const RotationMatrix<double>&);

void to_zonal(Convention convention, int order, std::span<const float> in, std::span<float> out) {
    convert_to_zonal(convention, order, in, out);
}

void to_zonal(Convention convention, int order, std::span<const double> in, std::span<double> out) {
    convert_to_zonal(convention, order, in, out);
}

void to_zonal(Convention convention, int order, std::span<const Rgb<float>> in, std::span<Rgb<float>> out) {
    convert_to_zonal(convention, order, in, out);
}

void to_zonal(Convention convention, int order, std::span<const Rgb<double>> in, std::span<Rgb<double>> out) {
    convert_to_zonal(convention, order, in, out);
}

void from_zonal(Convention convention, int order, std::span<const float> in, std::span<float> out) {
    convert_from_zonal(convention, order, in, out);
}

void from_zonal(Convention convention, int order, std::span<const double> in, std::span<double> out) {
    convert_from_zonal(convention, order, in, out);
}

void from_zonal(Convention convention, int order, std::span<const Rgb<float>> in, std::span<Rgb<float>> out) {
    convert_from_zonal(convention, order, in, out);
}

void from_zonal(Convention convention, int order, std::span<const Rgb<double>> in,
                std::span<Rgb<double>> out) {
    convert_from_zonal(convention, order, in, out);
}

void rotate(Convention convention, int order, const RotationMatrix<float>& rotation,
            std::span<const float> in, std::span<float> out) {
    call_with_channels(order, in, out,
                       [&](auto from, auto to) { rotate_within(convention, order, rotation, from, to); });
}

void rotate(Convention convention, int order, const RotationMatrix<double>& rotation,
            std::span<const double> in, std::span<double> out) {
    call_with_channels(order, in, out,
                       [&](auto from, auto to) { rotate_within(convention, order, rotation, from, to); });
}

void rotate(Convention convention, int order, const RotationMatrix<float>& rotation,
            std::span<const Rgb<float>> in, std::span<Rgb<float>> out) {
    rotate_within(convention, order, rotation, in, out);
}

void rotate(Convention convention, int order, const RotationMatrix<double>& rotation,
            std::span<const Rgb<double>> in, std::span<Rgb<double>> out) {
    rotate_within(convention, order, rotation, in, out);
}

}  // namespace zonal
