#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "emit/unit.hpp"
#include "graph/kernel.hpp"
#include "lobes/order_tables.hpp"

namespace zonal {

/// An entry of a file of bounds (generator/tables/README.md says how they are measured).
struct MeasuredBound {
    std::string kernel;
    int order = 0;
    std::string table;  ///< short hash of the table it is of; empty where the kernel needs none
    emit::Bound bound;
};

/// Throws `UserError` naming file, field, value and next step.
std::vector<MeasuredBound> read_bounds(const std::filesystem::path& path);

/// The project's published error bounds by kernel: of an order those of kernels that need no table, and of
/// the very table that `rotate_zhf` is made of. Throws `UserError` where a kernel has none, but for one of a
/// table that somebody chose, which nobody has measured.
std::map<std::string, emit::Bound> published_bounds(int order, const OrderTables& tables,
                                                    const std::vector<graph::Kernel>& kernels);

}  // namespace zonal
