#include "kernels/order_kernels.hpp"

#include <fmt/format.h>

#include <optional>

#include "io/user_error.hpp"
#include "kernels/lobes.hpp"
#include "kernels/registry.hpp"
#include "lobes/tables_folder.hpp"

namespace zonal {

void check_order(int order, int smallest) {
    if (order < smallest || order > kLargestOrder)
        throw UserError(fmt::format("--order: found {}, wanted {} … {}", order, smallest, kLargestOrder));
}

TableShelf project_tables() {
    return TableShelf(tables_folder(), [](const BandFactorization& band) {
        return kernels::factorization_counts(band).instructions();
    });
}

OrderKernels build_order_kernels(TableShelf& shelf, int order, const std::filesystem::path& table_path) {
    using kernels::LobeSet;
    check_order(order);
    OrderKernels result{order, shelf.of_order(order, table_path), kernels::plan_order(order), {}};
    const OrderTables& tables = result.tables;
    std::optional<LobeSet> shared, turned, per_band;
    if (tables.shared) shared = LobeSet::shared(tables.shared->table);
    if (tables.has_own_rotate_zhf()) turned = LobeSet::shared(tables.rotate_zhf->table);
    if (!tables.per_band.empty()) {
        std::vector<const LobeTable*> bands;
        for (const TablePointer& source : tables.per_band) bands.push_back(&source->table);
        per_band = LobeSet::per_band(bands);
    }
    const auto pointer = [](const std::optional<LobeSet>& set) { return set ? &*set : nullptr; };
    result.kernels = kernels::build_order(
        order, result.plans,
        {.shared = pointer(shared), .turned = pointer(turned), .per_band = pointer(per_band)});
    return result;
}

OrderKernels build_order_kernels(int order, const std::filesystem::path& table_path) {
    TableShelf shelf = project_tables();
    return build_order_kernels(shelf, order, table_path);
}

}  // namespace zonal
