#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "emit/unit.hpp"
#include "graph/kernel.hpp"
#include "kernels/lobes.hpp"
#include "lobe_table.hpp"

namespace zonal {

/// Band 2 is the first whose lobes can be chosen.
inline constexpr int kSmallestOrder = 3;
inline constexpr int kLargestOrder = 20;
/// Digits of a table's sha256 that banners and the file of bounds name it by.
inline constexpr int kHashDigits = 16;

/// Throws `UserError` unless the generator serves this order.
void check_order(int order);

/// A table and the kernels built from it, as `emit` and `stats` need them.
struct OrderKernels {
    LobeTable table;
    std::string table_name;  ///< how a banner names the table: no path of a machine
    kernels::LobeSet lobes;
    std::vector<graph::Kernel> kernels;
    std::map<std::string, emit::Bound> bounds;  ///< those published for this very table
};

/// Loads the table of an order (`table_path` empty: the project's own) and builds every kernel of that order.
OrderKernels build_order_kernels(int order, const std::filesystem::path& table_path);

}  // namespace zonal
