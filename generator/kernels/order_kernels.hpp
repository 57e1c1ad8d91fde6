#pragma once

#include <filesystem>
#include <vector>

#include "graph/kernel.hpp"
#include "kernels/rotations.hpp"
#include "lobes/order_tables.hpp"

namespace zonal {

/// Order 1 is a constant: nothing turns.
inline constexpr int kSmallestOrder = 2;
inline constexpr int kLargestOrder = 20;

/// Throws `UserError` unless `smallest` <= order <= kLargestOrder.
void check_order(int order, int smallest = kSmallestOrder);

/// The kernels of an order, as `emit` and `stats` need them, and what they are made of.
struct OrderKernels {
    int order = 0;
    OrderTables tables;
    kernels::OrderPlans plans;
    std::vector<graph::Kernel> kernels;
};

/// The tables of the project, for as many orders as are wanted of it.
TableShelf project_tables();

/// Plans and builds every kernel of an order. `table_path` empty: the project's own table, or none where it
/// has none.
OrderKernels build_order_kernels(TableShelf& shelf, int order, const std::filesystem::path& table_path = {});

/// The same for one order alone.
OrderKernels build_order_kernels(int order, const std::filesystem::path& table_path = {});

}  // namespace zonal
