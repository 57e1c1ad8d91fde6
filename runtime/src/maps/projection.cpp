// Projects maps and functions onto spherical harmonics, and draws coefficients as maps.
//
// y_l^m(theta, phi) = p_l^|m|(theta) times cos(m phi) or sin(|m| phi), so an integral over the sphere is, per
// row of texels, 2 order - 1 sums over phi and then one sum over theta. phi   : over a texel of width d the
// integral of cos(m phi) is d sinc(m d / 2) cos(m phi_centre), likewise sin. theta : p_l^m sin(theta) is a
// trigonometric polynomial of degree at most order, integrated by Gauss's rule. Limits: the rule is exact to
// rounding while (degree x length of the interval) stays below 4, see kGauss.

#include "zonal/projection.hpp"

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

struct PolarNode {
    double sin_theta;
    double cos_theta;
    double weight;  ///< includes sin(theta)
};

/// The 8-point rule of Gauss and Legendre on [-1, 1]: abscissas (both signs) and weights, Abramowitz and
/// Stegun, table 25.4. Its error for exp(i k theta) over a length h is h (k h)^16 (8!)^4 / (17 (16!)^3),
/// which is 7e-14 h at k h = 4.
constexpr std::array<std::array<double, 2>, 4> kGauss = {{{0.183434642495649805, 0.362683783378361983},
                                                          {0.525532409916328986, 0.313706645877887287},
                                                          {0.796666477413626740, 0.222381034453374471},
                                                          {0.960289856497536232, 0.101228536290376259}}};

/// The nodes of row `row` when [0, pi] is cut into `rows` equal parts.
std::array<PolarNode, 2 * kGauss.size()> polar_nodes(int row, int rows) {
    const double half_height = 0.5 * pi / rows;
    const double centre = (2 * row + 1) * half_height;
    std::array<PolarNode, 2 * kGauss.size()> nodes;
    auto node = nodes.begin();
    for (const auto& [abscissa, weight] : kGauss) {
        for (const double offset : {-abscissa, abscissa}) {
            const double theta_rad = centre + half_height * offset;
            *node++ = {std::sin(theta_rad), std::cos(theta_rad), half_height * weight * std::sin(theta_rad)};
        }
    }
    return nodes;
}

/// Integrals of p_l^m(theta) sin(theta) over a row, at index l(l+1)+m, m >= 0; the others mean nothing.
void integrate_row(int order, int row, int rows, std::span<double> integrals) {
    std::array<double, kMaxOrder * kMaxOrder> storage;
    const std::span<double> basis = std::span(storage).first(integrals.size());
    std::ranges::fill(integrals, 0.0);
    for (const PolarNode& node : polar_nodes(row, rows)) {
        evaluate_basis(order, {node.sin_theta, 0.0, node.cos_theta}, basis);  // phi = 0: cos(m phi) = 1
        for (std::size_t i = 0; i < basis.size(); ++i) integrals[i] += node.weight * basis[i];
    }
}

/// Integrals of cos(m phi) and sin(m phi) over each texel of a row.
struct AzimuthTable {
    AzimuthTable(int order, int width)
        : cosines(static_cast<std::size_t>(order) * width), sines(cosines.size()) {
        const double step = 2 * pi / width;
        for (int m = 0; m < order; ++m) {
            const double half_angle = 0.5 * m * step;
            const double texel = m == 0 ? step : step * std::sin(half_angle) / half_angle;
            for (int column = 0; column < width; ++column) {
                const std::size_t i = static_cast<std::size_t>(m) * width + column;
                cosines[i] = texel * std::cos(m * (column + 0.5) * step);
                sines[i] = texel * std::sin(m * (column + 0.5) * step);
            }
        }
    }
    std::vector<double> cosines;  ///< [m][column]
    std::vector<double> sines;
};

Rgb<double> inner_product(std::span<const Rgb<double>> texels, const double* weights) {
    Rgb<double> sum;
    for (std::size_t i = 0; i < texels.size(); ++i) sum = sum + weights[i] * texels[i];
    return sum;
}

void check_map(int order, const EnvironmentMap& map) {
    const auto texels = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
    if (map.height < 1 || map.width != 2 * map.height || map.texels.size() != texels) {
        throw Error({.field = "map",
                     .found = joined(map.width, " x ", map.height, " with ", map.texels.size(), " texels"),
                     .wanted = "width = 2 height and one texel for each place",
                     .next_step = "make the map with black_map or read_environment_map"});
    }
    if (map.height < order) {
        throw Error({.field = joined("height of the map for order ", order),
                     .found = text_of(map.height),
                     .wanted = joined("at least ", order, " rows"),
                     .next_step = "use a finer map or a lower order"});
    }
}

/// R^T d.
Direction turned_back(const RotationMatrix<double>& r, const Direction& d) {
    const auto column = [&](int k) { return r(0, k) * d.x + r(1, k) * d.y + r(2, k) * d.z; };
    return {column(0), column(1), column(2)};
}

}  // namespace

std::vector<Rgb<double>> project(int order, const EnvironmentMap& map) {
    check_order(order);
    check_map(order, map);
    const AzimuthTable azimuth(order, map.width);
    std::vector<Rgb<double>> coefficients(static_cast<std::size_t>(order) * order);
    std::vector<double> integrals(coefficients.size());
    std::vector<Rgb<double>> texels(map.width);
    for (int row = 0; row < map.height; ++row) {
        for (int column = 0; column < map.width; ++column)
            texels[column] = map.at(column, row).cast<double>();
        integrate_row(order, row, map.height, integrals);
        for (int m = 0; m < order; ++m) {
            const std::size_t start = static_cast<std::size_t>(m) * map.width;
            const Rgb<double> cosine_sum = inner_product(texels, &azimuth.cosines[start]);
            const Rgb<double> sine_sum = inner_product(texels, &azimuth.sines[start]);
            for (int l = m; l < order; ++l) {
                const int centre = l * (l + 1);
                const double p = integrals[centre + m];
                coefficients[centre + m] = coefficients[centre + m] + p * cosine_sum;
                if (m > 0) coefficients[centre - m] = coefficients[centre - m] + p * sine_sum;
            }
        }
    }
    return coefficients;
}

std::vector<Rgb<double>> project(int order, const std::function<Rgb<double>(const Direction&)>& function) {
    check_order(order);
    // Function times basis has degree at most 2 order - 2: 2 order equal steps of phi are exact, and 2 order
    // rows keep (degree x height) of the theta integrand below pi.
    const int rows = 2 * order;
    const int columns = 2 * order;
    std::vector<Rgb<double>> coefficients(static_cast<std::size_t>(order) * order);
    std::vector<double> basis(coefficients.size());
    for (int row = 0; row < rows; ++row) {
        for (const PolarNode& node : polar_nodes(row, rows)) {
            for (int column = 0; column < columns; ++column) {
                const double phi_rad = 2 * pi * (column + 0.5) / columns;
                const Direction direction(node.sin_theta * std::cos(phi_rad),
                                          node.sin_theta * std::sin(phi_rad), node.cos_theta);
                evaluate_basis(order, direction, basis);
                const Rgb<double> value = (node.weight * 2 * pi / columns) * function(direction);
                for (std::size_t i = 0; i < basis.size(); ++i) {
                    coefficients[i] = coefficients[i] + basis[i] * value;
                }
            }
        }
    }
    return coefficients;
}

EnvironmentMap reconstruct(int order, std::span<const Rgb<double>> coefficients, int height) {
    return reconstruct_rotated(order, coefficients, RotationMatrix<double>(), height);
}

EnvironmentMap reconstruct_rotated(int order, std::span<const Rgb<double>> coefficients,
                                   const RotationMatrix<double>& rotation, int height) {
    check_order(order);
    check_length("coefficients", order, coefficients.size());
    if (height < 1) {
        throw Error({.field = "height of the map",
                     .found = text_of(height),
                     .wanted = "at least 1",
                     .next_step = "ask for a map with rows"});
    }
    EnvironmentMap map = black_map(height);
    for (int row = 0; row < map.height; ++row) {
        for (int column = 0; column < map.width; ++column) {
            const Direction direction = texel_direction(map.width, map.height, column, row);
            const Direction source = turned_back(rotation, direction);
            map.at(column, row) = evaluate(order, coefficients, source).cast<float>();
        }
    }
    return map;
}

}  // namespace zonal
