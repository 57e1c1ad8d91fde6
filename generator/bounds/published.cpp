#include "bounds/published.hpp"

#include <fmt/format.h>

#include "io/input_file.hpp"
#include "io/json_text.hpp"
#include "io/user_error.hpp"
#include "lobes/tables_folder.hpp"
#include "program/numbers.hpp"

namespace zonal {
namespace {

[[noreturn]] void complain(const std::string& path, const std::string& field, const std::string& found,
                           const std::string& wanted) {
    throw UserError(fmt::format(
        "{}: {}: found {}, wanted {}; restore the file, or measure all bounds anew: zonal-measure-bounds "
        "--out NEW.json",
        path, field, found, wanted));
}

std::string table_of(const OrderTables& tables) {
    return tables.rotate_zhf ? tables.rotate_zhf->table.short_hash() : "";
}

}  // namespace

std::vector<MeasuredBound> read_bounds(const std::filesystem::path& path) {
    const std::string name = path.string();
    Json file;
    try {
        file = parse_json(read_file(path));
    } catch (const Unreadable& error) {
        complain(name, "file", fmt::format("nothing that can be read ({})", error.what()),
                 "the error bounds that banners publish");
    } catch (const WrongJson& error) {
        complain(name, "JSON text", error.what(), "a whole file of bounds (this one may be truncated)");
    }
    std::vector<MeasuredBound> bounds;
    const auto list = field_as<std::vector<Json>>(
        file, "bounds", [&](const std::string& found) { complain(name, "bounds", found, "a list"); });
    for (const Json& entry : list) {
        const auto text = [&](const char* field) {
            return field_as<std::string>(entry, field, [&](const std::string& found) {
                complain(name, fmt::format("bounds[{}].{}", bounds.size(), field), found, "a text");
            });
        };
        const auto decimal = [&](const char* field) {  // goes into generated code as it stands
            const std::string number = text(field);
            if (!program::number_in(number, program::above(0, 1e6)))
                complain(name, fmt::format("bounds[{}].{}", bounds.size(), field), shown_value(Json(number)),
                         "a positive decimal");
            return number;
        };
        const int order = field_as<int>(entry, "order", [&](const std::string& found) {
            complain(name, fmt::format("bounds[{}].order", bounds.size()), found, "a whole number");
        });
        bounds.push_back(
            {text("kernel"), order, text("table"), {decimal("float"), decimal("double"), decimal("excess")}});
    }
    return bounds;
}

std::map<std::string, emit::Bound> published_bounds(int order, const OrderTables& tables,
                                                    const std::vector<graph::Kernel>& kernels) {
    const std::filesystem::path path = tables_folder() / "bounds.json";
    std::map<std::string, emit::Bound> published;
    for (const MeasuredBound& bound : read_bounds(path))
        if (bound.order == order && (bound.table.empty() || bound.table == table_of(tables)))
            published[bound.kernel] = bound.bound;
    for (const graph::Kernel& kernel : kernels) {
        const bool is_of_chosen = kernel.needs_lobes && tables.chosen && tables.rotate_zhf == tables.chosen;
        if (!kernel.has_bound || is_of_chosen || published.contains(kernel.full_name())) continue;
        const std::string of_table =
            kernel.needs_lobes ? fmt::format(" made of the table sha256:{}", table_of(tables)) : "";
        throw UserError(fmt::format(
            "{}: bounds: found none of {} of order {}{}, wanted one; restore the tables and this file, or, "
            "after a change of either or of the kernel, measure: zonal-measure-bounds --orders {} --out {}",
            path.string(), kernel.full_name(), order, of_table, order, path.string()));
    }
    return published;
}

}  // namespace zonal
