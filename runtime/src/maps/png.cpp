#include "zonal/png.hpp"

#include <stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "core/text.hpp"
#include "zonal/error.hpp"
#include "zonal/finite.hpp"

namespace zonal {
namespace {

constexpr int kChannels = 3;

void check_panels(const std::filesystem::path& path, std::span<const EnvironmentMap> panels) {
    for (const EnvironmentMap& panel : panels) {
        if (panel.height == panels.front().height) continue;
        throw Error({.file = path.string(),
                     .field = "height of a panel",
                     .found = text_of(panel.height),
                     .wanted = joined(panels.front().height, ", as the first panel has"),
                     .next_step = "draw all panels in one height"});
    }
    if (panels.empty() || panels.front().height < 1) {
        throw Error({.file = path.string(),
                     .field = "panels",
                     .found = "nothing to draw",
                     .wanted = "at least one map with texels",
                     .next_step = "pass a map"});
    }
}

std::vector<std::uint8_t> srgb_pixels(std::span<const EnvironmentMap> panels, float exposure) {
    std::vector<std::uint8_t> pixels;
    for (int row = 0; row < panels.front().height; ++row) {
        for (const EnvironmentMap& panel : panels) {
            for (int column = 0; column < panel.width; ++column) {
                const Rgb<float> value = exposure * panel.at(column, row);
                for (const float channel : {value.r, value.g, value.b}) pixels.push_back(srgb_byte(channel));
            }
        }
    }
    return pixels;
}

void append_bytes(void* destination, void* data, int size) {
    static_cast<std::string*>(destination)->append(static_cast<const char*>(data), size);
}

/// Encoded in memory, since stb_image_write does not notice a disk that is full.
std::string encode(const std::vector<std::uint8_t>& pixels, int height) {
    const int row_bytes = static_cast<int>(pixels.size()) / height;
    std::string bytes;
    stbi_write_png_to_func(append_bytes, &bytes, row_bytes / kChannels, height, kChannels, pixels.data(),
                           row_bytes);
    return bytes;
}

void write_and_rename(const std::filesystem::path& path, const std::string& bytes) {
    std::filesystem::path part = path;
    part += ".part";
    std::ofstream stream(part, std::ios::binary);
    stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    stream.close();
    std::error_code failure;
    if (stream) std::filesystem::rename(part, path, failure);
    if (stream && !failure) return;
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw Error({.file = path.string(),
                 .field = "output",
                 .found = "a file that cannot be written",
                 .wanted = "a writable folder with room on its disk",
                 .next_step = "check the folder, its permissions and the free space"});
}

}  // namespace

std::uint8_t srgb_byte(float linear) {
    if (detail::is_nan(linear) || linear <= 0) return 0;
    const float clamped = std::min(linear, 1.0F);
    const float encoded =
        clamped <= 0.0031308F ? 12.92F * clamped : 1.055F * std::pow(clamped, 1 / 2.4F) - 0.055F;
    return static_cast<std::uint8_t>(std::lround(255 * encoded));
}

void write_png(const std::filesystem::path& path, std::span<const EnvironmentMap> panels, float exposure) {
    check_panels(path, panels);
    write_and_rename(path, encode(srgb_pixels(panels, exposure), panels.front().height));
}

}  // namespace zonal
