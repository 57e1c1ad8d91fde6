#pragma once

#include <CLI/CLI.hpp>

namespace zonal {

/// `zonal-gen search`: seeks the lobe directions of an order and saves them as a table.
void add_search_command(CLI::App& app);

}  // namespace zonal
