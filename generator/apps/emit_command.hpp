#pragma once

#include <CLI/CLI.hpp>

namespace zonal {

/// `zonal-gen emit`: writes the kernels of an order in one language.
void add_emit_command(CLI::App& app);

}  // namespace zonal
