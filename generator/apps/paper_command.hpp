#pragma once

#include <CLI/CLI.hpp>

namespace zonal {

/// `zonal-gen paper`: prints this project's numbers beside the paper's Tables I and II, Figure 3 and eq. 8.
void add_paper_command(CLI::App& app);

}  // namespace zonal
