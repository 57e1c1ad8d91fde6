// zonal rotate-map: shows on an environment map that a kernel rotates as it should.
//
// Projects the map to SH, rotates its three channels by the kernel of that order in float, and compares with
// f(R^T w) evaluated point by point in double, as pictures and as numbers.
#include "rotate_map.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "program/numbers.hpp"
#include "program/program.hpp"
#include "zonal/basis.hpp"
#include "zonal/eigen.hpp"
#include "zonal/environment_map.hpp"
#include "zonal/error.hpp"
#include "zonal/png.hpp"
#include "zonal/projection.hpp"
#include "zonal/rotate.hpp"

namespace {

using Coefficients = std::vector<zonal::Rgb<double>>;

constexpr int kPanelHeight = 128;
/// Linear value at which the mean of the map is shown.
constexpr double kMiddleGrey = 0.2;

struct Options {
    int order = 4;
    std::filesystem::path map;
    std::vector<double> axis = {1.0, 2.0, 3.0};  // asymmetric: every entry of the matrix is different
    double angle_degrees = 70.0;
    std::filesystem::path out;
};

zonal::RotationMatrix<double> rotation_of(const Options& options) {
    const Eigen::Vector3d axis(options.axis[0], options.axis[1], options.axis[2]);
    if (axis.isZero(0)) {
        throw zonal::Error({.field = "--axis",
                            .found = "0 0 0",
                            .wanted = "a vector that is not zero",
                            .next_step = "give three numbers, for instance --axis 1 2 3"});
    }
    const double angle_rad = options.angle_degrees * std::numbers::pi / 180.0;
    // Scaled first: the length of an axis of the largest numbers is no number (stableNormalized gives 0).
    const Eigen::Vector3d scaled = axis / axis.cwiseAbs().maxCoeff();
    return zonal::RotationMatrix<double>(Eigen::AngleAxisd(angle_rad, scaled.normalized()));
}

Coefficients rotated_by_kernel(int order, const Coefficients& coefficients,
                               const zonal::RotationMatrix<double>& rotation) {
    std::vector<zonal::Rgb<float>> signal;
    for (const auto& value : coefficients) signal.push_back(value.cast<float>());
    zonal::rotate(order, rotation.cast<float>(), signal, signal);
    Coefficients rotated;
    for (const auto& value : signal) rotated.push_back(value.cast<double>());
    return rotated;
}

double largest_difference(const Coefficients& a, const Coefficients& b) {
    double largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const zonal::Rgb<double> d = a[i] - b[i];
        largest = std::max({largest, std::abs(d.r), std::abs(d.g), std::abs(d.b)});
    }
    return largest;
}

/// Shows the mean of the map, f_00 y_00 averaged over the channels, as middle grey.
float exposure_for(const Coefficients& coefficients) {
    const zonal::Rgb<double>& f = coefficients.front();
    const double mean = (f.r + f.g + f.b) / 3 / std::sqrt(4 * std::numbers::pi);
    return mean > 0 ? static_cast<float>(kMiddleGrey / mean) : 1.0F;
}

/// The largest power of ten that keeps the exposed difference within white.
float difference_factor(float exposed_difference) {
    return exposed_difference > 0 ? std::pow(10.0F, -std::ceil(std::log10(exposed_difference))) : 1.0F;
}

void create_folder(const std::filesystem::path& folder) {
    std::error_code failure;
    std::filesystem::create_directories(folder, failure);
    if (std::filesystem::is_directory(folder)) return;
    throw zonal::Error({.file = folder.string(),
                        .field = "--out",
                        .found = fmt::format("a folder that cannot be made ({})", failure.message()),
                        .wanted = "a folder, or a place where one can be made",
                        .next_step = "choose another folder"});
}

/// All is computed before the first file is written, so bad input leaves nothing behind.
void run(const Options& options) {
    const zonal::RotationMatrix<double> rotation = rotation_of(options);
    const zonal::EnvironmentMap map = zonal::read_environment_map(options.map);
    const Coefficients coefficients = zonal::project(options.order, map);
    const Coefficients by_kernel = rotated_by_kernel(options.order, coefficients, rotation);
    const Coefficients by_evaluation = zonal::project(options.order, [&](const zonal::Direction& direction) {
        const Eigen::Vector3d source = rotation.matrix().transpose() * zonal::to_eigen(direction);
        return zonal::evaluate(options.order, coefficients, source);
    });

    const auto before = zonal::reconstruct(options.order, coefficients, kPanelHeight);
    const auto kernel = zonal::reconstruct(options.order, by_kernel, kPanelHeight);
    const auto direct = zonal::reconstruct_rotated(options.order, coefficients, rotation, kPanelHeight);
    const float exposure = exposure_for(coefficients);
    const float pixel_difference = zonal::largest_value(zonal::absolute_difference(kernel, direct, 1.0F));
    const float factor = difference_factor(exposure * pixel_difference);
    const auto difference = zonal::absolute_difference(kernel, direct, factor);

    create_folder(options.out);
    const std::array panels = {before, kernel, direct, difference};
    const std::array names = {"before.png", "kernel.png", "direct.png", "difference.png"};
    for (std::size_t i = 0; i < panels.size(); ++i) {
        zonal::write_png(options.out / names[i], std::span(panels).subspan(i, 1), exposure);
    }
    zonal::write_png(options.out / "side_by_side.png", panels, exposure);

    fmt::print("order {}, {} x {} map, exposure {:.3g}\n", options.order, map.width, map.height, exposure);
    fmt::print("largest difference of a coefficient : {:.3g} (largest coefficient {:.3g})\n",
               largest_difference(by_kernel, by_evaluation),
               largest_difference(by_evaluation, Coefficients(by_evaluation.size())));
    fmt::print("largest difference of a pixel       : {:.3g} (largest pixel {:.3g})\n", pixel_difference,
               zonal::largest_value(direct));
    fmt::print("difference.png shows the difference times {:.0e}\n", factor);
    fmt::print("side_by_side.png: before | rotated by the kernel | f(R^T w) evaluated | difference\n");
}

}  // namespace

namespace zonal {

void add_rotate_map_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand(
        "rotate-map", "rotate an environment map by an SH kernel and compare with direct evaluation");
    const auto options = std::make_shared<Options>();
    program::add_number(*command, "--order", options->order, program::at_least(1), "number of SH bands")
        ->capture_default_str();
    command->add_option("--map", options->map, "latitude-longitude map, OpenEXR or Radiance .hdr")
        ->required();
    program::add_numbers(*command, "--axis", options->axis, {}, "axis of the rotation: x y z, any length")
        ->expected(3)
        ->capture_default_str();
    program::add_number(*command, "--angle-degrees", options->angle_degrees, {}, "angle of the rotation")
        ->capture_default_str();
    command->add_option("--out", options->out, "folder for the pictures")->required();
    command->callback([options] { run(*options); });
}

}  // namespace zonal
