#include "bounds/published.hpp"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "io/user_error.hpp"
#include "lobes/tables_folder.hpp"

namespace zonal {

std::map<std::string, emit::Bound> published_bounds(int order, const OrderTables& tables) {
    const std::filesystem::path path = tables_folder() / "bounds.json";
    const std::string table = tables.rotate_zhf ? tables.rotate_zhf->table.short_hash() : "";
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

}  // namespace zonal
