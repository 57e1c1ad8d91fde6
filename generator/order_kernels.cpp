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

std::optional<OrderLobes> load_lobes(int order, const std::filesystem::path& table_path) {
    const bool is_own = table_path.empty();
    const LobeUse use = LobeUse::order(order);
    const std::filesystem::path path = is_own ? tables_folder() / use.table_name() : table_path;
    if (is_own && !std::filesystem::exists(path)) return std::nullopt;
    OrderLobes lobes;
    lobes.source = {read_lobe_table(path, use),
                    is_own ? name_in_banner(use.table_name()) : path.filename().string()};
    lobes.set = kernels::LobeSet::shared(order, lobes.source.table.directions);
    return lobes;
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
    result.lobes = load_lobes(order, table_path);
    if (result.lobes) result.band_lobes = load_band_lobes(order);
    result.kernels =
        kernels::build_order(order, {.shared = result.lobes ? &result.lobes->set : nullptr,
                                     .per_band = result.band_lobes ? &result.band_lobes->set : nullptr});
    result.bounds = read_bounds(tables_folder() / "bounds.json", order,
                                result.lobes ? result.lobes->source.table.sha256.substr(0, kHashDigits) : "");
    return result;
}

}  // namespace zonal
