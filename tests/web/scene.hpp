#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "zonal/rgb.hpp"
#include "zonal/rotation.hpp"

namespace zonal::web {

/// What the page renders and the judge computes again: every order with every rotation, orders outermost.
/// Numbers of the light and of rotations are floats, in both programs the same bits.
struct Scene {
    int size = 0;                  ///< of a picture in pixels, a power of two
    std::vector<int> orders = {};  ///< each at most 4
    double matte = 0;              ///< share of the clamped cosine's light; a few bits, so exact in float
    double mirror = 0;             ///< share of the light from the mirrored direction; the same
    float exposure = 0;            ///< for the eye only
    std::vector<Rgb<float>> light = {};  ///< of the largest order; lower orders take its beginning
    std::vector<RotationMatrix<float>> rotations = {};
};

/// The light of a latitude-longitude map, turning about an axis that favours no coordinate, from no turn at
/// all (a pole of the kernel's angles) on. Errors: those of read_environment_map.
Scene scene_of_map(const std::filesystem::path& map);

/// JSON with the names above; light as triples, rotations as nine values, row-major.
/// Errors: std::runtime_error naming the file, and what is wrong with it.
void write_scene(const Scene& scene, const std::filesystem::path& path);
Scene read_scene(const std::filesystem::path& path);

}  // namespace zonal::web
