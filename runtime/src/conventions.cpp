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

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "checks.hpp"
#include "zonal/error.hpp"
#include "zonal/rotate.hpp"

namespace zonal {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kMaxLength = kMaxOrder * kMaxOrder;

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
    bool is_scaled_within_bands = false;
    int min_order = 1;
    int max_order = kMaxOrder;
};

constexpr auto kDefinitions = std::to_array<Definition>({
    {Convention::kGaussianSplatting, "3dgs", Axes::kHalfTurnAboutZ},
    {Convention::kGaussianSplatting, "khr_gaussian_splatting", Axes::kHalfTurnAboutZ},
    {Convention::kDirectX, "directx", Axes::kHalfTurnAboutZ, true},
    {Convention::kGoogle, "google", Axes::kHalfTurnAboutZ},
    {Convention::kAmbixSn3d, "ambix_sn3d"},
    {Convention::kAmbixN3d, "ambix_n3d"},
    {Convention::kFuMa, "fuma", Axes::kOurs, false, true, 1, 4},
    {Convention::kUnityL2, "unity_l2", Axes::kOurs, false, true, 3, 3},
    {Convention::kThreeJs, "threejs", Axes::kOurs, false, false, 3, 3},
    {Convention::kE3nn, "e3nn", Axes::kYPolar},
});

const Definition& definition_of(Convention convention) {
    const auto found = std::ranges::find(kDefinitions, convention, &Definition::convention);
    if (found != kDefinitions.end()) return *found;
    throw Error({.field = "convention",
                 .found = fmt::format("the number {}", static_cast<int>(convention)),
                 .wanted = "one of the enumerators of zonal::Convention",
                 .next_step = "use convention_from_name to read a convention"});
}

void check_call(const Definition& definition, int order, std::size_t in, std::size_t out) {
    if (order < definition.min_order || order > definition.max_order) {
        const bool is_single = definition.min_order == definition.max_order;
        throw Error({.field = fmt::format("order of a signal in the convention {}", definition.name),
                     .found = fmt::format("{}", order),
                     .wanted = is_single
                                   ? fmt::format("{}", definition.min_order)
                                   : fmt::format("{} to {}", definition.min_order, definition.max_order),
                     .next_step = "choose an order (number of bands) that the convention has"});
    }
    check_length("in", order, in);
    check_length("out", order, out);
}

/// theirs[j] = scale * ours[index], in the convention's axes.
struct Place {
    int index = 0;
    double scale = 1;
};

/// W X Y Z, R S T U V, K L M N O P Q in our index, and FuMa over SN3D: maxN's weights, for W 1 / sqrt(2).
const std::array<Place, 16>& fuma_over_sn3d() {
    static const double first = 2 / std::sqrt(3.0), second = std::sqrt(45.0 / 32);
    static const double third = 3 / std::sqrt(5.0), fourth = std::sqrt(8.0 / 5);
    static const std::array<Place, 16> places = {{{0, std::sqrt(0.5)},
                                                  {3, 1},
                                                  {1, 1},
                                                  {2, 1},
                                                  {6, 1},
                                                  {7, first},
                                                  {5, first},
                                                  {8, first},
                                                  {4, first},
                                                  {12, 1},
                                                  {13, second},
                                                  {11, second},
                                                  {14, third},
                                                  {10, third},
                                                  {15, fourth},
                                                  {9, fourth}}};
    return places;
}

/// A unit source is y_l^m(d) in our basis and, in SN3D, has W = 1: SN3D over ours.
double sn3d_scale(int l) { return std::sqrt(4 * kPi / (2 * l + 1)); }

/// Unity stores the factors of 1, y, z, x, xy, yz, 3 z^2 - 1, xz, x^2 - y^2: ours times the basis constants.
double unity_scale(int l, int m) {
    if (l == 0) return std::sqrt(1 / (4 * kPi));
    if (l == 1) return std::sqrt(3 / (4 * kPi));
    if (m == 0) return std::sqrt(5 / (16 * kPi));
    return std::sqrt((m == 2 ? 15 / 4.0 : 15) / (4 * kPi));
}

Place place_of(Convention convention, int l, int m) {
    const int index = l * (l + 1) + m;
    switch (convention) {
        case Convention::kAmbixSn3d:
            return {index, sn3d_scale(l)};
        case Convention::kAmbixN3d:
            return {index, std::sqrt(4 * kPi)};
        case Convention::kFuMa: {
            if (l > 3) return {};
            const Place& place = fuma_over_sn3d()[index];
            return {place.index, sn3d_scale(l) * place.scale};
        }
        case Convention::kUnityL2:
            return {index, l > 2 ? 1 : unity_scale(l, m)};
        default:
            return {index, 1};
    }
}

using Layout = std::array<Place, kMaxLength>;

Layout make_layout(Convention convention) {
    Layout layout;
    for (int l = 0; l < kMaxOrder; ++l) {
        for (int m = -l; m <= l; ++m) layout[l * (l + 1) + m] = place_of(convention, l, m);
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

/// Room for one signal of any order, so that no call allocates.
template <class V>
class Signal {
  public:
    explicit Signal(int order) : length_(static_cast<std::size_t>(order) * order) {}
    std::span<V> values() { return std::span(storage_).first(length_); }

  private:
    std::size_t length_;
    std::array<V, kMaxLength> storage_{};
};

template <class V>
void to_our_places(const Layout& layout, std::span<const V> theirs, std::span<V> ours) {
    for (std::size_t j = 0; j < theirs.size(); ++j)
        ours[layout[j].index] = static_cast<Scalar<V>>(1 / layout[j].scale) * theirs[j];
}

template <class V>
void to_their_places(const Layout& layout, std::span<const V> ours, std::span<V> theirs) {
    for (std::size_t j = 0; j < theirs.size(); ++j)
        theirs[j] = static_cast<Scalar<V>>(layout[j].scale) * ours[layout[j].index];
}

/// P, of determinant +1.
Eigen::Matrix3d axes_matrix(Axes axes) {
    Eigen::Matrix3d p;
    switch (axes) {
        case Axes::kHalfTurnAboutZ:
            return Eigen::Vector3d(-1, -1, 1).asDiagonal();
        case Axes::kYPolar:
            p << 0, 0, 1, 1, 0, 0, 0, 1, 0;
            return p;
        case Axes::kOurs:
            break;
    }
    return Eigen::Matrix3d::Identity();
}

template <class V>
void negate_odd_m(std::span<V> signal) {
    for (int l = 1; l * l < static_cast<int>(signal.size()); ++l) {
        for (int m = -l; m <= l; ++m) {
            V& value = signal[l * (l + 1) + m];
            if (m % 2 != 0) value = -value;
        }
    }
}

enum class Direction { kToOurs, kToTheirs };

/// From g to f(w) = g(P w) or back: a rotation of g by P^T, or of f by P.
template <class V>
void turn_axes(Axes axes, Direction direction, int order, std::span<V> signal) {
    if (axes == Axes::kHalfTurnAboutZ) negate_odd_m(signal);
    if (axes != Axes::kYPolar) return;
    const Eigen::Matrix3d p = axes_matrix(axes);
    const RotationMatrix<Scalar<V>> turn(direction == Direction::kToOurs ? Eigen::Matrix3d(p.transpose())
                                                                         : p);
    rotate(order, turn, std::span<const V>(signal), signal);
}

template <class V>
void convert_to_zonal(Convention convention, int order, std::span<const V> in, std::span<V> out) {
    const Definition& definition = definition_of(convention);
    check_call(definition, order, in.size(), out.size());
    Signal<V> ours(order);
    to_our_places(layout_of(convention), in, ours.values());
    turn_axes(definition.axes, Direction::kToOurs, order, ours.values());
    std::ranges::copy(ours.values(), out.begin());
}

template <class V>
void convert_from_zonal(Convention convention, int order, std::span<const V> in, std::span<V> out) {
    const Definition& definition = definition_of(convention);
    check_call(definition, order, in.size(), out.size());
    Signal<V> ours(order);
    std::ranges::copy(in, ours.values().begin());
    turn_axes(definition.axes, Direction::kToTheirs, order, ours.values());
    to_their_places(layout_of(convention), std::span<const V>(ours.values()), out);
}

template <class T, class V>
void rotate_within(Convention convention, int order, const RotationMatrix<T>& rotation, std::span<const V> in,
                   std::span<V> out) {
    const Definition& definition = definition_of(convention);
    check_call(definition, order, in.size(), out.size());
    const RotationMatrix<T> turn = kernel_rotation(convention, rotation);
    if (!definition.is_scaled_within_bands) return rotate(order, turn, in, out);
    Signal<V> ours(order);
    to_our_places(layout_of(convention), in, ours.values());
    rotate(order, turn, std::span<const V>(ours.values()), ours.values());
    to_their_places(layout_of(convention), std::span<const V>(ours.values()), out);
}

}  // namespace

std::vector<std::string_view> convention_names() {
    std::vector<std::string_view> names;
    for (const Definition& definition : kDefinitions) names.push_back(definition.name);
    return names;
}

Convention convention_from_name(std::string_view name) {
    const auto found = std::ranges::find(kDefinitions, name, &Definition::name);
    if (found != kDefinitions.end()) return found->convention;
    throw Error({.field = "convention",
                 .found = fmt::format("'{}'", name),
                 .wanted = fmt::format("one of: {}", fmt::join(convention_names(), ", ")),
                 .next_step = "choose the library that wrote the data"});
}

template <class T>
RotationMatrix<T> kernel_rotation(Convention convention, const RotationMatrix<T>& rotation) {
    using Matrix = typename RotationMatrix<T>::Matrix;
    const Definition& definition = definition_of(convention);
    const Matrix columns =
        definition.multiplies_rows ? Matrix(rotation.matrix().transpose()) : rotation.matrix();
    const Matrix p = axes_matrix(definition.axes).cast<T>();
    return RotationMatrix<T>(Matrix(p * columns * p.transpose()));
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
    rotate_within(convention, order, rotation, in, out);
}

void rotate(Convention convention, int order, const RotationMatrix<double>& rotation,
            std::span<const double> in, std::span<double> out) {
    rotate_within(convention, order, rotation, in, out);
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
