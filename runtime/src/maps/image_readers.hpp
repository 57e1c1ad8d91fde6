#pragma once

#include <filesystem>

#include "zonal/environment_map.hpp"

namespace zonal {

/// A black map for a file whose header states this size. Throws zonal::Error unless width = 2 height > 0.
EnvironmentMap black_map_for_file(const std::filesystem::path& path, int width, int height);

struct DecodedMap {
    EnvironmentMap map;
    bool is_dwa;  ///< coded with a loss that can turn black into a small negative value
};

/// Each throws zonal::Error naming `path` when the file cannot be decoded whole.
DecodedMap read_openexr(const std::filesystem::path& path);
DecodedMap read_radiance(const std::filesystem::path& path);

}  // namespace zonal
