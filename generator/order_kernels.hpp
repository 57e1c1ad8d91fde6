#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "emit/unit.hpp"
#include "graph/kernel.hpp"
#include "kernels/lobes.hpp"
#include "lobe_table.hpp"

namespace zonal {

/// Order 1 is a constant: nothing turns.
inline constexpr int kSmallestOrder = 2;
inline constexpr int kLargestOrder = 20;

/// Throws `UserError` unless `smallest` <= order <= kLargestOrder.
void check_order(int order, int smallest = kSmallestOrder);

/// A table and how a banner names it: no path of a machine.
struct NamedTable {
    LobeTable table;
    std::string name;
};

/// The lobes that all bands of an order share.
struct OrderLobes {
    NamedTable source;
    kernels::LobeSet set;
};

/// The lobes that bands 2 … order-1 have of their own.
struct BandLobes {
    std::vector<NamedTable> sources;  ///< of those bands: the sparsest lobes or those closed under mirrors
    kernels::LobeSet set;             ///< of all bands; bands 0 and 1 take the pole and the axes
};

/// The kernels of an order, as `emit` and `stats` need them.
struct OrderKernels {
    int order = 0;
    std::optional<OrderLobes> lobes;      ///< none where the project has no table of this order
    std::optional<OrderLobes> turned;     ///< those of `rotate_zhf`, where they are better conditioned ones
    std::optional<BandLobes> band_lobes;  ///< none where a band's table is missing
    std::vector<graph::Kernel> kernels;
    std::map<std::string, emit::Bound> bounds;  ///< those published for these very kernels

    /// The table that `rotate_zhf` is made from; precondition: there are lobes.
    const NamedTable& turned_source() const { return turned ? turned->source : lobes->source; }
};

/// Loads the table of an order and builds every kernel. `table_path` empty: the project's own table, or none
/// where it has none.
OrderKernels build_order_kernels(int order, const std::filesystem::path& table_path);

}  // namespace zonal
