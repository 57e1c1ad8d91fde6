#include "order_kernels.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "kernels/registry.hpp"
#include "tables_folder.hpp"
#include "user_error.hpp"

namespace zonal {

namespace {

/// Published error bounds from the committed file that `zonal-measure-bounds` writes
/// (generator/tables/README.md): those of kernels that need no table, and of the very table that is used.
std::map<std::string, emit::Bound> read_bounds(const std::filesystem::path& path, int order,
                                               const std::string& table) {
    std::ifstream stream(path);
    if (!stream) return {};
    std::map<std::string, emit::Bound> bounds;
    try {
        const auto file = nlohmann::json::parse(stream);
        for (const auto& entry : file.at("bounds"))
            if (entry.at("order") == order && (entry.at("table") == "" || entry.at("table") == table))
                bounds[entry.at("kernel")] = {entry.at("float"), entry.at("double"), entry.at("excess")};
    } catch (const nlohmann::json::exception& error) {
        throw UserError(
            fmt::format("{}: {}; write it again with zonal-measure-bounds", path.string(), error.what()));
    }
    return bounds;
}

std::string name_in_banner(const std::filesystem::path& table_name) {
    return ("generator/tables" / table_name).string();
}

OrderLobes read_lobes(int order, const std::filesystem::path& path, const std::string& name) {
    OrderLobes lobes;
    lobes.source = {read_lobe_table(path, LobeUse::order(order)), name};
    lobes.set = kernels::LobeSet::shared(order, lobes.source.table.directions);
    return lobes;
}

/// The lobes of the project's own table of this name; none where it has no such table.
std::optional<OrderLobes> load_own_lobes(int order, const std::filesystem::path& table_name) {
    const std::filesystem::path path = tables_folder() / table_name;
    if (!std::filesystem::exists(path)) return std::nullopt;
    return read_lobes(order, path, name_in_banner(table_name));
}

/// Of a band's tables the one whose product takes fewest instructions; none where it has no table.
std::optional<NamedTable> cheapest_table(int l) {
    const LobeUse use = LobeUse::band(l);
    std::optional<NamedTable> cheapest;
    int fewest = 0;
    for (const std::filesystem::path& name : {use.table_name(), use.mirrored_table_name()}) {
        if (!std::filesystem::exists(tables_folder() / name)) continue;
        NamedTable source{read_lobe_table(tables_folder() / name, use), name_in_banner(name)};
        const exact::BandFactorization band = exact::factorize_band(l, source.table.directions);
        const int instructions = kernels::factorization_counts(band).instructions();
        if (cheapest && instructions >= fewest) continue;
        cheapest = std::move(source);
        fewest = instructions;
    }
    return cheapest;
}

std::optional<BandLobes> load_band_lobes(int order) {
    using Direction = exact::Direction<exact::Real>;
    BandLobes lobes;
    std::vector<std::vector<Direction>> directions{
        {Direction::UnitZ()}, {Direction::UnitY(), Direction::UnitZ(), Direction::UnitX()}};
    for (int l = 2; l < order; ++l) {
        const std::optional<NamedTable> source = cheapest_table(l);
        if (!source) return std::nullopt;
        directions.push_back(source->table.directions);
        lobes.sources.push_back(*source);
    }
    lobes.set = kernels::LobeSet::per_band(directions);
    return lobes;
}

}  // namespace

void check_order(int order, int smallest) {
    if (order < smallest || order > kLargestOrder)
        throw UserError(fmt::format("--order: found {}, wanted {} … {}", order, smallest, kLargestOrder));
}

OrderKernels build_order_kernels(int order, const std::filesystem::path& table_path) {
    check_order(order);
    OrderKernels result;
    result.order = order;
    if (table_path.empty()) {
        const LobeUse use = LobeUse::order(order);
        result.lobes = load_own_lobes(order, use.table_name());
        if (result.lobes) result.turned = load_own_lobes(order, use.conditioned_table_name());
    } else {
        result.lobes = read_lobes(order, table_path, table_path.filename().string());
    }
    if (result.lobes) result.band_lobes = load_band_lobes(order);
    const auto set_of = [](const auto& lobes) { return lobes ? &lobes->set : nullptr; };
    result.kernels = kernels::build_order(order, {.shared = set_of(result.lobes),
                                                  .turned = set_of(result.turned),
                                                  .per_band = set_of(result.band_lobes)});
    result.bounds = read_bounds(tables_folder() / "bounds.json", order,
                                result.lobes ? result.turned_source().table.short_hash() : "");
    return result;
}

}  // namespace zonal
