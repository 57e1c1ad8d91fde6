#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lobes/lobe_table.hpp"

namespace zonal {

/// A table and how a banner names it: no path of a machine.
struct NamedTable {
    LobeTable table;
    std::string name;
};
using TablePointer = std::shared_ptr<const NamedTable>;

/// The tables that the kernels of an order are made of. Each is null, or empty, where there is none; without
/// `shared` there are no others.
struct OrderTables {
    TablePointer chosen;      ///< the one of those below that was asked for, if any
    TablePointer shared;      ///< of every lobe kernel that is not named below
    TablePointer rotate_zhf;  ///< of `rotate_zhf`: better conditioned lobes, or `shared` again
    /// Of the kernels of variant `per_band`: of bands 2 … order-1 the table whose product takes fewest
    /// instructions, the sparsest lobes or those closed under mirrors.
    std::vector<TablePointer> per_band;

    bool has_own_rotate_zhf() const { return rotate_zhf != shared; }
};

/// Throws `UserError` unless every published table is in the folder.
void check_tables_are_there(const std::filesystem::path& folder);

/// A folder of tables, and which of them serves what. A table is read and verified once, however many orders
/// need it.
class TableShelf {
  public:
    /// Instructions of the emitted product Âᵀ f.
    using EmittedCost = std::function<int(const BandFactorization&)>;

    TableShelf(std::filesystem::path folder, EmittedCost emitted_cost)
        : folder_(std::move(folder)), emitted_cost_(std::move(emitted_cost)) {}

    /// The folder's table of a use; null where it has none. Throws `UserError` where one is published and
    /// missing: kernels are never made of fewer tables in silence.
    TablePointer find(const LobeUse& use);

    /// What serves an order. `chosen`: a table to take for what it says it is for, that of the folder for the
    /// rest; empty: all are the folder's. Throws `UserError`.
    OrderTables of_order(int order, const std::filesystem::path& chosen = {});

  private:
    TablePointer cheapest_of_band(int l);

    std::filesystem::path folder_;
    EmittedCost emitted_cost_;
    std::map<std::filesystem::path, TablePointer> known_;
    std::map<int, TablePointer> cheapest_;
};

}  // namespace zonal
