#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "zonal/api.hpp"
#include "zonal/environment_map.hpp"

namespace zonal {

/// A linear value as an 8-bit sRGB value (IEC 61966-2-1): clamped to 0 … 1 (NaN gives 0), the sRGB curve,
/// rounded to nearest.
ZONAL_API std::uint8_t srgb_byte(float linear);

/// Writes maps as one 8-bit sRGB PNG, side by side from left to right.
/// Tone mapping: value times `exposure`, then srgb_byte; so negative values become black, large ones white.
/// The file is written as `path` + ".part" and renamed when complete; a failed call leaves neither.
/// Errors: zonal::Error when there is no map, the heights differ, or the file cannot be written.
ZONAL_API void write_png(const std::filesystem::path& path, std::span<const EnvironmentMap> panels,
                         float exposure);

}  // namespace zonal
