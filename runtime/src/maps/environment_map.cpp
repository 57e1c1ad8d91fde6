#include "zonal/environment_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <system_error>
#include <utility>

#include "core/text.hpp"
#include "image_readers.hpp"
#include "zonal/error.hpp"
#include "zonal/finite.hpp"

namespace zonal {
namespace {

/// DWA noise allowed below zero, relative to the largest value of the map. The largest seen in four published
/// maps of 1024 x 512 texels (studio.exr of the tests among them) is 4.7e-7.
constexpr float kDwaNoise = 1e-6F;

/// Larger sizes are taken for a corrupt header, before memory is claimed for them.
constexpr int kMaxHeight = 16384;

std::string first_bytes(const std::filesystem::path& path) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(path, ignored)) {
        const bool exists = std::filesystem::exists(path, ignored);
        throw Error({.file = path.string(),
                     .field = "file",
                     .found = exists ? "something that is not a regular file" : "no such file",
                     .wanted = "an environment map",
                     .next_step = "check the path"});
    }
    std::ifstream stream(path, std::ios::binary);
    if (!stream) {
        throw Error({.file = path.string(),
                     .field = "file",
                     .found = "a file that cannot be opened",
                     .wanted = "a readable file",
                     .next_step = "check its permissions"});
    }
    std::array<char, 16> bytes;
    stream.read(bytes.data(), bytes.size());
    return {bytes.data(), static_cast<std::size_t>(stream.gcount())};
}

DecodedMap decode(const std::filesystem::path& path) {
    const std::string bytes = first_bytes(path);
    if (bytes.starts_with("\x76\x2f\x31\x01")) return read_openexr(path);
    if (bytes.starts_with("#?RADIANCE\n") || bytes.starts_with("#?RGBE\n")) return read_radiance(path);
    throw Error({.file = path.string(),
                 .field = "first bytes",
                 .found = bytes.empty() ? "an empty file" : "those of another format",
                 .wanted = "OpenEXR or Radiance HDR",
                 .next_step = "convert the map to one of these"});
}

void check_texels(const std::filesystem::path& path, const EnvironmentMap& map, float lowest) {
    for (int row = 0; row < map.height; ++row) {
        for (int column = 0; column < map.width; ++column) {
            const Rgb<float>& texel = map.at(column, row);
            const std::array<std::pair<const char*, float>, 3> channels = {
                {{"red", texel.r}, {"green", texel.g}, {"blue", texel.b}}};
            for (const auto& [name, value] : channels) {
                if (detail::is_finite(value) && value >= lowest) continue;
                throw Error({.file = path.string(),
                             .field = joined("texel at column ", column, ", row ", row, ", ", name),
                             .found = text_of(value),
                             .wanted = "a finite value that is not negative",
                             .next_step = "repair the map, for instance by painting over this texel"});
            }
        }
    }
}

}  // namespace

EnvironmentMap black_map(int height) {
    const auto rows = static_cast<std::size_t>(height);
    return {2 * height, height, std::vector<Rgb<float>>(2 * rows * rows)};
}

EnvironmentMap black_map_for_file(const std::filesystem::path& path, int width, int height) {
    const bool is_two_to_one = height > 0 && width % 2 == 0 && width / 2 == height;
    if (is_two_to_one && height <= kMaxHeight) return black_map(height);
    throw Error(
        {.file = path.string(),
         .field = "size",
         .found = joined(width, " x ", height, " texels"),
         .wanted = joined("a latitude-longitude map, width = 2 height, of at most ", kMaxHeight, " rows"),
         .next_step = "convert the image to latitude-longitude, or make it smaller"});
}

Direction texel_direction(int width, int height, int column, int row) {
    const double theta_rad = std::numbers::pi * (row + 0.5) / height;
    const double phi_rad = 2 * std::numbers::pi * (column + 0.5) / width;
    return {std::sin(theta_rad) * std::cos(phi_rad), std::sin(theta_rad) * std::sin(phi_rad),
            std::cos(theta_rad)};
}

EnvironmentMap read_environment_map(const std::filesystem::path& path) {
    DecodedMap decoded = decode(path);
    // NaN and infinity are found whatever the bound: largest_value ignores NaN and the check wants finite
    // values.
    const float lowest = decoded.is_dwa ? -kDwaNoise * largest_value(decoded.map) : 0.0F;
    check_texels(path, decoded.map, lowest);
    return std::move(decoded.map);
}

EnvironmentMap absolute_difference(const EnvironmentMap& a, const EnvironmentMap& b, float scale) {
    EnvironmentMap difference = a;
    for (std::size_t i = 0; i < a.texels.size(); ++i) {
        const Rgb<float> d = a.texels[i] - b.texels[i];
        difference.texels[i] = scale * Rgb<float>{std::abs(d.r), std::abs(d.g), std::abs(d.b)};
    }
    return difference;
}

float largest_value(const EnvironmentMap& map) {
    float largest = 0;
    for (const Rgb<float>& texel : map.texels) largest = std::max({largest, texel.r, texel.g, texel.b});
    return largest;
}

}  // namespace zonal
