#include "lobes/order_tables.hpp"

namespace zonal {

TablePointer TableShelf::find(const LobeUse& use) {
    const auto [known, is_new] = known_.try_emplace(use.table_path());
    const std::filesystem::path path = folder_ / use.table_path();
    if (is_new && std::filesystem::exists(path))
        known->second = std::make_shared<NamedTable>(
            NamedTable{read_lobe_table(path, use), ("generator/tables" / use.table_path()).string()});
    return known->second;
}

TablePointer TableShelf::cheapest_of_band(int l) {
    const auto [known, is_new] = cheapest_.try_emplace(l);
    if (!is_new) return known->second;
    int fewest = 0;
    for (const TableRole role : {TableRole::band, TableRole::band_mirrored}) {
        const TablePointer table = find(LobeUse::band(l, role));
        if (!table) continue;
        const int instructions = emitted_cost_(table->table.bands.front());
        if (known->second && instructions >= fewest) continue;
        known->second = table;
        fewest = instructions;
    }
    return known->second;
}

OrderTables TableShelf::of_order(int order, const std::filesystem::path& chosen) {
    OrderTables tables;
    if (chosen.empty()) {
        tables.shared = find(LobeUse::order(order));
        if (tables.shared) tables.rotate_zhf = find(LobeUse::order(order, TableRole::rotate_zhf));
    } else {
        tables.shared = std::make_shared<NamedTable>(
            NamedTable{read_lobe_table(chosen, LobeUse::order(order)), chosen.filename().string()});
    }
    if (!tables.shared) return tables;
    if (!tables.rotate_zhf) tables.rotate_zhf = tables.shared;
    for (int l = 2; l < order; ++l) {
        const TablePointer cheapest = cheapest_of_band(l);
        if (!cheapest) {
            tables.per_band.clear();
            break;
        }
        tables.per_band.push_back(cheapest);
    }
    return tables;
}

}  // namespace zonal
