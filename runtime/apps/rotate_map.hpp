#pragma once

#include <CLI/CLI.hpp>

namespace zonal {

/// `zonal rotate-map`: rotates an environment map by a kernel and shows how far it is from direct evaluation.
void add_rotate_map_command(CLI::App& app);

}  // namespace zonal
