#include "apps/stats_command.hpp"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "apps/order_kernels.hpp"
#include "graph/counts.hpp"
#include "graph/schedule.hpp"
#include "kernels/lobes.hpp"

namespace zonal {

namespace {

using Json = nlohmann::ordered_json;

struct Options {
    int order = 0;
    std::string table;
    bool as_json = false;
};

Json to_json(const graph::Counts& counts) {
    return {{"mul", counts.mul}, {"add", counts.add}, {"fma", counts.fma}, {"other", counts.other}};
}

Json to_json(const graph::Kernel& kernel) {
    const graph::Cost cost = graph::count_operations(kernel);
    Json json = to_json(cost.total());
    json["multiplications"] = cost.total().multiplications();
    json["instructions"] = cost.total().instructions();
    json["per_rotation"] = to_json(cost.per_rotation);
    json["per_vector"] = to_json(cost.per_vector);
    json["peak_live_values"] = graph::peak_live_values(kernel, graph::schedule(kernel));
    return json;
}

Json to_json(const OrderKernels& order) {
    Json bands = Json::array();
    for (int l = 0; l < order.table.order; ++l)
        bands.push_back({{"band", l},
                         {"entries", (2 * l + 1) * (2 * l + 1)},
                         {"zeros", order.table.zeros[l]},
                         {"multiplications", kernels::factorization_multiplications(order.lobes.bands[l])},
                         {"cond", order.table.condition[l]}});
    Json kernels;
    for (const graph::Kernel& kernel : order.kernels) kernels[kernel.name] = to_json(kernel);
    return {{"order", order.table.order},
            {"table", order.table_name},
            {"nonzeros", order.table.nonzeros},
            {"bands", bands},
            {"kernels", kernels}};
}

void print_table(const Json& stats) {
    fmt::print("{:<6}{:>9}{:>8}{:>17}{:>12}\n", "band", "entries", "zeros", "multiplications", "cond");
    for (const Json& band : stats["bands"])
        fmt::print("{:<6}{:>9}{:>8}{:>17}{:>12.4g}\n", band["band"].get<int>(), band["entries"].get<int>(),
                   band["zeros"].get<int>(), band["multiplications"].get<int>(), band["cond"].get<double>());
    fmt::print("\n{:<12}{:>6}{:>6}{:>6}{:>7}   {}\n", "kernel", "mul", "add", "fma", "other",
               "of these once per rotation (mul add fma other)");
    for (const auto& [name, kernel] : stats["kernels"].items()) {
        const Json& once = kernel["per_rotation"];
        fmt::print("{:<12}{:>6}{:>6}{:>6}{:>7}   {} {} {} {}\n", name, kernel["mul"].get<int>(),
                   kernel["add"].get<int>(), kernel["fma"].get<int>(), kernel["other"].get<int>(),
                   once["mul"].get<int>(), once["add"].get<int>(), once["fma"].get<int>(),
                   once["other"].get<int>());
    }
}

}  // namespace

void add_stats_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("stats", "count the operations of every kernel of an order");
    const auto options = std::make_shared<Options>();
    command->add_option("--order", options->order, "number of bands")->required();
    command->add_option("--table", options->table, "lobe table (default: generator/tables/orderNN.json)");
    command->add_flag("--json", options->as_json, "print JSON");
    command->callback([options] {
        const Json stats = to_json(build_order_kernels(options->order, options->table));
        if (options->as_json)
            fmt::print("{}\n", stats.dump(2));
        else
            print_table(stats);
    });
}

}  // namespace zonal
