// Plans and fills the cube maps of signal-tailored rotation. The bound stands in the header.

#include "zonal/signal_tables.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/checks.hpp"
#include "core/text.hpp"
#include "zonal/basis.hpp"
#include "zonal/eigen.hpp"
#include "zonal/error.hpp"
#include "zonal/finite.hpp"
#include "zonal/orders.hpp"

namespace zonal {
namespace {

constexpr int kFaces = 6;
constexpr double kFloatUnit = 0x1p-24;

/// How texels are rounded: relative to their size, and absolute where they are denormal.
template <class T>
struct Format;
template <>
struct Format<float> {
    static constexpr const char* kName = "float";
    static constexpr const char* kOther = "the signal is too uneven, or the budget below what float keeps";
    static constexpr double kRelative = kFloatUnit, kAbsolute = 0x1p-150, kLargest = 3.4e38;
};
template <>
struct Format<Eigen::half> {
    static constexpr const char* kName = "half";
    static constexpr const char* kOther = "take float texels";
    static constexpr double kRelative = 0x1p-11, kAbsolute = 0x1p-25, kLargest = 65504;
};

int band_size(int l) { return 2 * l + 1; }

void check_lobe_order(int order) {
#define ZONAL_LIST_ENTRY(N) N,
    static const std::vector<int> orders{ZONAL_FOR_EACH_LOBE_ORDER(ZONAL_LIST_ENTRY)};
#undef ZONAL_LIST_ENTRY
    if (std::ranges::find(orders, order) != orders.end()) return;
    throw Error({.field = "order",
                 .found = text_of(order),
                 .wanted = joined("an order that has lobes and is compiled in: ", list_of(orders)),
                 .next_step = "search a lobe table, add the order to cmake/orders.cmake and build again"});
}

void resample(int order, const double* samples, double* out) {
    switch (order) {
#define ZONAL_CASE(N) \
    case N:           \
        return order##N::resample<double>(samples, out);
        ZONAL_FOR_EACH_LOBE_ORDER(ZONAL_CASE)
#undef ZONAL_CASE
    }
}

/// Â_l of the order's shared lobes, as the kernel multiplies by it.
Eigen::MatrixXd lobe_matrix(int order, int l) {
    std::vector<double> samples(order * order), out(order * order);
    Eigen::MatrixXd matrix(band_size(l), band_size(l));
    for (int d = 0; d < band_size(l); ++d) {
        samples[l * l + d] = 1;
        resample(order, samples.data(), out.data());
        samples[l * l + d] = 0;
        for (int i = 0; i < band_size(l); ++i) matrix(i, d) = out[l * l + i];
    }
    return matrix;
}

/// f_l from the basis' values in a direction.
Rgb<double> band_value(int l, std::span<const Rgb<float>> signal, std::span<const double> basis) {
    Rgb<double> sum;
    for (int i = l * l; i < (l + 1) * (l + 1); ++i) sum = sum + basis[i] * signal[i].cast<double>();
    return sum;
}

double norm(std::span<const Rgb<float>> values) {
    double sum = 0;
    for (const auto& [r, g, b] : values) sum += 1.0 * r * r + 1.0 * g * g + 1.0 * b * b;
    return std::sqrt(sum);
}

/// The largest length of f_l over all directions, from above. Where a function of degree l on a great circle
/// has its maximum M, it is at least M (1 - l² r² / 2) at a distance of r: so a grid finds nearly all of it.
double largest_value(int order, int l, std::span<const Rgb<float>> signal) {
    constexpr int kGrid = 33;
    constexpr double kDistance = 2 / (kFaceScale * kGrid) / std::numbers::sqrt2;
    static_assert(kDistance * (kMaxOrder - 1) < 1);
    std::vector<double> basis(order * order);
    double largest = 0;
    for (int face = 0; face < kFaces; ++face) {
        for (int texel = 0; texel < kGrid * kGrid; ++texel) {
            evaluate_basis(order, face_texel_direction(kGrid, face, texel / kGrid, texel % kGrid), basis);
            const Rgb<double> value = band_value(l, signal, basis);
            largest = std::max(largest, std::hypot(value.r, value.g, value.b));
        }
    }
    const double by_norm =
        std::sqrt(band_size(l) / (4 * std::numbers::pi)) * norm(signal.subspan(l * l, band_size(l)));
    return std::min(by_norm, largest / (1 - std::pow(l * kDistance, 2) / 2));
}

/// max over u of (l² + 2 l u) / (1 + u²)²: of the second derivative along a line of a face, where c = 1.
double largest_bend(int l) {
    const double u = (std::sqrt(l * l + 3.0) - l) / 3;
    return (l * l + 2 * l * u) / std::pow(1 + u * u, 2);
}

/// The error of a rotated band relative to the whole signal, as a function of the face's size.
struct BandError {
    double quadratic = 0, linear = 0, constant = 0;  ///< in h, the distance of texels
    double excess = 0;                               ///< times ||R R^T - I||_F

    double at(int size) const {
        const double h = 2 / (kFaceScale * size);
        return (quadratic * h + linear) * h + constant;
    }
};

/// `scale` is ||f||.
template <class T>
BandError band_error(int order, int l, std::span<const Rgb<float>> signal, double scale, int subtexel_bits) {
    const Eigen::MatrixXd a = lobe_matrix(order, l);
    const double spectral = Eigen::JacobiSVD<Eigen::MatrixXd>(a).singularValues()(0);
    const double gain = std::min(spectral * std::sqrt(band_size(l)), a.cwiseAbs().rowwise().sum().norm());
    const double peak = largest_value(order, l, signal) / scale;  // M
    BandError error;
    error.quadratic = gain * peak * largest_bend(l) / 4;
    error.linear = gain * peak * 2 * std::ldexp(l, -subtexel_bits);
    // Roundings in units of float. A turned lobe has 4 a component, off by 7 in all; then 10 for each of two
    // coordinates of a face: scale 1, division 5, shift and multiplication by the size 2 and 2. Filter 8.
    const double roundings = (7 + 2 * 10) * l + 8;
    error.constant = gain * (peak * (Format<T>::kRelative + roundings * kFloatUnit) +
                             std::sqrt(3.0) * Format<T>::kAbsolute / scale);
    // The sparse product: a sum of 2l+1 products, their constants rounded.
    error.constant += (band_size(l) + 2) * kFloatUnit * a.norm() * std::sqrt(band_size(l)) * peak;
    error.excess = gain * peak * l / 2;
    return error;
}

/// The errors of all tabulated bands, and of those that need no table.
struct SignalError {
    std::vector<BandError> bands;
    double low = 0, low_excess = 0;

    double at(std::span<const int> sizes) const {
        double sum = low * low;
        for (std::size_t k = 0; k < bands.size(); ++k) sum += std::pow(bands[k].at(sizes[k]), 2);
        return std::sqrt(sum);
    }
    double at(int size) const { return at(std::vector<int>(bands.size(), size)); }
    double limit() const {
        double sum = low * low;
        for (const BandError& band : bands) sum += band.constant * band.constant;
        return std::sqrt(sum);
    }
    double excess() const {
        double sum = low_excess * low_excess;
        for (const BandError& band : bands) sum += band.excess * band.excess;
        return std::sqrt(sum);
    }
};

template <class T>
SignalError signal_error(int order, std::span<const Rgb<float>> signal, int subtexel_bits) {
    const double scale = norm(signal);
    SignalError error;
    // Three sums of three products, 3 roundings each.
    const double share_of_1 = norm(signal.subspan(1, 3)) / scale;
    error.low = std::sqrt(3.0) * 3 * kFloatUnit * share_of_1;
    error.low_excess = share_of_1 / 2;
    for (int l = kFirstTableBand; l < order; ++l)
        error.bands.push_back(band_error<T>(order, l, signal, scale, subtexel_bits));
    return error;
}

template <class T>
void check_signal(int order, std::span<const Rgb<float>> signal) {
    check_length("signal", order, signal.size());
    for (std::size_t i = 0; i < signal.size(); ++i) {
        for (const float value : {signal[i].r, signal[i].g, signal[i].b}) {
            if (detail::is_finite(value)) continue;
            throw Error({.field = joined("signal, coefficient ", i),
                         .found = text_of(value),
                         .wanted = "a finite number",
                         .next_step = "mend the signal"});
        }
    }
    if (norm(signal) == 0)
        throw Error({.field = "signal",
                     .found = "zeros only",
                     .wanted = "a coefficient that is not zero",
                     .next_step = "a signal of zeros needs no rotation"});
    for (int l = kFirstTableBand; l < order; ++l) {
        const double peak = largest_value(order, l, signal);
        if (peak <= Format<T>::kLargest) continue;
        throw Error({.field = joined("signal, band ", l),
                     .found = joined("values of up to ", rounded(peak, 4)),
                     .wanted = joined("at most ", Format<T>::kLargest, ", the largest ", Format<T>::kName),
                     .next_step = "divide the signal by a power of two and multiply the rotated one by it"});
    }
}

void check_options(const SignalTableOptions& options) {
    if (!(options.budget > 0) || !detail::is_finite(options.budget))
        throw Error({.field = "budget",
                     .found = text_of(options.budget),
                     .wanted = "a positive number, relative to the norm of the signal",
                     .next_step = "ask for 1e-3, for example"});
    const auto check_range = [](const char* field, int found, int smallest, int largest, const char* limit) {
        if (found >= smallest && found <= largest) return;
        throw Error({.field = field,
                     .found = text_of(found),
                     .wanted = joined(smallest, " to ", largest),
                     .next_step = joined("read it from VkPhysicalDeviceLimits::", limit)});
    };
    check_range("subtexel_bits", options.subtexel_bits, 1, 24, "subTexelPrecisionBits");
    check_range("largest_face", options.largest_face, kSmallestFace, 1 << 16, "maxImageDimensionCube");
}

template <class T>
void check_reachable(const SignalError& error, const SignalTableOptions& options) {
    const double reached = error.at(options.largest_face);
    if (reached <= options.budget) return;
    const double limit = error.limit();
    const bool is_rounding = options.budget <= limit;
    throw Error({.field = "budget",
                 .found = text_of(options.budget),
                 .wanted = joined(
                     "at least ", rounded_up(reached, 3), ": ",
                     is_rounding ? joined(Format<T>::kName, " texels of any number keep ", rounded(limit, 3))
                                 : joined("what faces of ", options.largest_face, " texels an edge keep")),
                 .next_step = is_rounding ? joined("raise the budget, or ", Format<T>::kOther)
                                          : "raise the budget or the largest face"});
}

std::vector<int> sizes_of(const std::vector<int>& levels, int face_size) {
    std::vector<int> sizes;
    for (const int level : levels) sizes.push_back(face_size >> level);
    return sizes;
}

/// The smallest size of level 0 with an error of at most `target` and no level below the smallest face; or
/// the largest face.
int smallest_face(const SignalError& error, const std::vector<int>& levels, double target, int largest_face) {
    int below = (kSmallestFace << std::ranges::max(levels)) - 1, size = largest_face;
    while (size - below > 1) {
        const int middle = below + (size - below) / 2;
        (error.at(sizes_of(levels, middle)) <= target ? size : below) = middle;
    }
    return size;
}

/// Coarser levels, the cheapest step in error first, as long as the budget lasts.
void coarsen(SignalTablePlan& plan, const SignalError& error, double budget) {
    while (true) {
        int best = -1;
        double least = budget;
        for (int layer = 0; layer < plan.layer_count(); ++layer) {
            const int coarser = plan.size_at(plan.levels[layer] + 1);
            if (coarser < kSmallestFace) continue;
            std::vector<int> sizes = sizes_of(plan.levels, plan.face_size);
            sizes[layer] = coarser;
            const double total = error.at(sizes);
            if (total > least) continue;
            best = layer;
            least = total;
        }
        if (best < 0) return;
        ++plan.levels[best];
    }
}

}  // namespace

std::size_t SignalTablePlan::first_texel(int level, int layer, int face) const {
    const auto area = [&](int k) { return static_cast<std::size_t>(size_at(k)) * size_at(k); };
    std::size_t first = 0;
    for (int k = 0; k < level; ++k) first += area(k) * kFaces * layer_count();
    return first + area(level) * (kFaces * layer + face);
}

template <class T>
SignalTablePlan plan_signal_tables(int order, std::span<const Rgb<float>> signal,
                                   const SignalTableOptions& options) {
    check_lobe_order(order);
    check_options(options);
    check_signal<T>(order, signal);
    const SignalError error = signal_error<T>(order, signal, options.subtexel_bits);
    check_reachable<T>(error, options);
    SignalTablePlan plan;
    plan.order = order;
    plan.levels.assign(plan.layer_count(), 0);
    const double limit = error.limit();
    plan.face_size = smallest_face(
        error, plan.levels, std::hypot(options.budget, limit) / std::numbers::sqrt2, options.largest_face);
    coarsen(plan, error, options.budget);
    // What is left of the budget.
    plan.face_size = smallest_face(error, plan.levels, options.budget, plan.face_size);
    plan.level_count = 1 + std::ranges::max(plan.levels);
    const std::vector<int> sizes = sizes_of(plan.levels, plan.face_size);
    for (int layer = 0; layer < plan.layer_count(); ++layer)
        plan.band_bounds.push_back(error.bands[layer].at(sizes[layer]));
    plan.bound = error.at(sizes);
    plan.excess = error.excess();
    return plan;
}

template <class T>
SignalTables<T> build_signal_tables(int order, std::span<const Rgb<float>> signal,
                                    const SignalTableOptions& options) {
    SignalTables<T> tables{plan_signal_tables<T>(order, signal, options), {}};
    const SignalTablePlan& plan = tables.plan;
    tables.texels.assign(4 * plan.texel_count(), T(0));
    std::vector<double> basis(order * order);
    for (int level = 0; level < plan.level_count; ++level) {
        const int size = plan.size_at(level);
        for (int face = 0; face < kFaces; ++face) {
            for (int texel = 0; texel < size * size; ++texel) {
                evaluate_basis(order, face_texel_direction(size, face, texel / size, texel % size), basis);
                for (int layer = 0; layer < plan.layer_count(); ++layer) {
                    const int l = kFirstTableBand + layer;
                    const Rgb<double> value = band_value(l, signal, basis);
                    T* out = &tables.texels[4 * (plan.first_texel(level, layer, face) + texel)];
                    out[0] = T(static_cast<float>(value.r));
                    out[1] = T(static_cast<float>(value.g));
                    out[2] = T(static_cast<float>(value.b));
                }
            }
        }
    }
    return tables;
}

Eigen::Vector3d face_texel_direction(int size, int face, int row, int column) {
    const double u = ((2 * column + 1.0) / size - 1) / kFaceScale;
    const double v = ((2 * row + 1.0) / size - 1) / kFaceScale;
    const std::array<Eigen::Vector3d, kFaces> directions{
        {{1, -v, -u}, {-1, -v, u}, {u, 1, v}, {u, -1, -v}, {u, -v, 1}, {-u, -v, -1}}};
    return directions[face].normalized();
}

// Marked again: Eigen::half is not a type of ours, and would hide what is made of it.
#define ZONAL_INSTANTIATE(T)                                                                    \
    template ZONAL_API SignalTablePlan plan_signal_tables<T>(int, std::span<const Rgb<float>>,  \
                                                             const SignalTableOptions&);        \
    template ZONAL_API SignalTables<T> build_signal_tables<T>(int, std::span<const Rgb<float>>, \
                                                              const SignalTableOptions&);
ZONAL_INSTANTIATE(float)
ZONAL_INSTANTIATE(Eigen::half)
#undef ZONAL_INSTANTIATE

}  // namespace zonal
