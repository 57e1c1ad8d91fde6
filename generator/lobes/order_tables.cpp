#include "lobes/order_tables.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "io/user_error.hpp"

namespace zonal {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void complain_of_missing(const fs::path& folder, const LobeUse& use) {
    const bool has_folder = fs::is_directory(folder);
    throw UserError(fmt::format(
        "{}: found no such {}, wanted the lobes of {} {} for {}, which come with zonal-gen; restore it, or "
        "name a whole folder of tables in the environment variable ZONAL_TABLES_DIR",
        (has_folder ? folder / use.table_path() : folder).string(), has_folder ? "file" : "folder", use.field,
        use.value, name_of(use.role)));
}

/// A path for banners: as it was typed, but never one of this machine.
std::string banner_name(const fs::path& path) {
    if (path.is_relative()) return path.lexically_normal().string();
    const fs::path here = path.lexically_normal().lexically_relative(fs::current_path());
    return (here.empty() || *here.begin() == ".." ? path.filename() : here).string();
}

void check_name(const fs::path& path) {
    const std::string name = path.string();
    const auto is_control = [](unsigned char byte) { return byte < 0x20 || byte == 0x7F; };
    if (std::ranges::any_of(name, is_control))
        throw UserError(fmt::format(
            "--table {}: found a control character in the name, wanted one that a comment holds on one line; "
            "rename the file",
            name));
}

}  // namespace

void check_tables_are_there(const fs::path& folder) {
    const auto check = [&](const LobeUse& use) {
        if (use.is_published() && !fs::exists(folder / use.table_path())) complain_of_missing(folder, use);
    };
    constexpr int kMost = 20;  // orders, and bands below them
    for (int k = 2; k <= kMost; ++k) {
        check(LobeUse::order(k));
        check(LobeUse::order(k, TableRole::rotate_zhf));
        check(LobeUse::band(k));
        check(LobeUse::band(k, TableRole::band_mirrored));
    }
}

TablePointer TableShelf::find(const LobeUse& use) {
    const auto [known, is_new] = known_.try_emplace(use.table_path());
    const fs::path path = folder_ / use.table_path();
    if (is_new && !fs::exists(path) && use.is_published()) {
        known_.erase(known);
        complain_of_missing(folder_, use);
    }
    if (is_new && fs::exists(path))
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

OrderTables TableShelf::of_order(int order, const fs::path& chosen) {
    OrderTables tables;
    if (!chosen.empty()) {
        if (order < 3)
            throw UserError(fmt::format(
                "--table {}: found with order {}, which needs no lobes: its bands turn with R itself; wanted "
                "order 3 or more; drop --table",
                chosen.string(), order));
        check_name(chosen);
        tables.chosen = std::make_shared<NamedTable>(
            NamedTable{read_lobe_table_of_any_role(chosen, LobeUse::order(order)), banner_name(chosen)});
    }
    const auto table_of = [&](TableRole role) {
        const bool is_chosen = tables.chosen && tables.chosen->table.use.role == role;
        return is_chosen ? tables.chosen : find(LobeUse::order(order, role));
    };
    tables.shared = table_of(TableRole::shared);
    if (!tables.shared) return tables;
    tables.rotate_zhf = table_of(TableRole::rotate_zhf);
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
