#include "apps/order_kernels.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "kernels/registry.hpp"
#include "user_error.hpp"

namespace zonal {

namespace {

/// Published error bounds of the kernels that a table gives, from the committed file that
/// `zonal-measure-bounds` writes: generator/tables/README.md.
std::map<std::string, emit::Bound> read_bounds(const std::filesystem::path& path, const LobeTable& table) {
    std::ifstream stream(path);
    if (!stream) return {};
    std::map<std::string, emit::Bound> bounds;
    try {
        const auto file = nlohmann::json::parse(stream);
        for (const auto& entry : file.at("bounds"))
            if (entry.at("order") == table.order && entry.at("table") == table.sha256.substr(0, kHashDigits))
                bounds[entry.at("kernel")] = {entry.at("float"), entry.at("double")};
    } catch (const nlohmann::json::exception& error) {
        throw UserError(
            fmt::format("{}: {}; write it again with zonal-measure-bounds", path.string(), error.what()));
    }
    return bounds;
}

}  // namespace

void check_order(int order) {
    if (order < kSmallestOrder || order > kLargestOrder)
        throw UserError(
            fmt::format("--order: found {}, wanted {} … {}", order, kSmallestOrder, kLargestOrder));
}

OrderKernels build_order_kernels(int order, const std::filesystem::path& table_path) {
    check_order(order);
    const bool is_own = table_path.empty();
    const std::filesystem::path path = is_own ? ZONAL_TABLES_DIR / lobe_table_name(order) : table_path;
    OrderKernels result;
    result.table = read_lobe_table(path, order);
    result.table_name =
        is_own ? ("generator/tables" / lobe_table_name(order)).string() : path.filename().string();
    result.lobes = {order, result.table.directions, exact::factorize_order(order, result.table.directions)};
    result.kernels = kernels::build_order(result.lobes);
    result.bounds = read_bounds(ZONAL_TABLES_DIR / "bounds.json", result.table);
    return result;
}

}  // namespace zonal
