#pragma once

#include <CLI/CLI.hpp>

namespace zonal {

/// `zonal-gen stats`: prints the counts of every kernel of an order, zeros and conditioning per band.
void add_stats_command(CLI::App& app);

}  // namespace zonal
