#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "zonal/api.hpp"
#include "zonal/direction.hpp"
#include "zonal/rgb.hpp"

namespace zonal {

/// A latitude-longitude image of the sphere: width = 2 height, texels row by row from the top, linear
/// radiance.
///
/// The centre of the texel in column i, row j looks along
///     theta = pi (j + 1/2) / height,   phi = 2 pi (i + 1/2) / width,
///     w = (sin theta cos phi, sin theta sin phi, cos theta):
/// the top row surrounds +z, the left edge is +x, a quarter to the right of it lies +y, the middle is -x.
/// This is the globe seen from outside; a viewer at the centre, z up, sees the picture mirrored left to
/// right.
struct EnvironmentMap {
    int width = 0;
    int height = 0;
    std::vector<Rgb<float>> texels = {};

    const Rgb<float>& at(int column, int row) const { return texels[index_of(column, row)]; }
    Rgb<float>& at(int column, int row) { return texels[index_of(column, row)]; }
    std::size_t index_of(int column, int row) const {
        return static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(column);
    }
};

/// A black map of 2 height x height texels. Precondition: height > 0.
ZONAL_API EnvironmentMap black_map(int height);

/// The unit vector through the centre of a texel, in the convention of EnvironmentMap.
ZONAL_API Direction texel_direction(int width, int height, int column, int row);

/// Reads a map from OpenEXR (any lossless compression or DWA) or Radiance .hdr, told apart by their first
/// bytes. Channels R, G and B are read, others ignored; exposure and colour-space fields are not applied.
/// Errors, all zonal::Error naming the file: it is missing, of another format, truncated or corrupt, lacks a
/// channel, is not twice as wide as high, or has a texel that is NaN, infinite or negative (the first is
/// named). DWA rounds in a frequency space, so a black texel may decode to a small negative value: a DWA file
/// may hold values down to -1e-6 times its largest. They are kept as decoded, since clamping noise of zero
/// mean would bias every integral.
ZONAL_API EnvironmentMap read_environment_map(const std::filesystem::path& path);

/// |a - b| times `scale` in every channel. Precondition: maps of one size.
ZONAL_API EnvironmentMap absolute_difference(const EnvironmentMap& a, const EnvironmentMap& b, float scale);

/// The largest value of any channel; 0 for an empty map or one without positive values.
ZONAL_API float largest_value(const EnvironmentMap& map);

}  // namespace zonal
