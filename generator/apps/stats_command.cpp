#include "apps/stats_command.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "bounds/chosen_rotate.hpp"
#include "bounds/published.hpp"
#include "graph/call_time.hpp"
#include "graph/counts.hpp"
#include "graph/schedule.hpp"
#include "kernels/lobes.hpp"
#include "kernels/order_kernels.hpp"
#include "kernels/planner.hpp"
#include "kernels/rotations.hpp"
#include "program/numbers.hpp"
#include "program/program.hpp"

namespace zonal {

namespace {

using Json = nlohmann::ordered_json;

struct StatsOptions {
    int order = 0;
    std::string table;
    bool as_json = false;
};

Json to_json(const graph::Counts& counts) {
    return {{"mul", counts.mul}, {"add", counts.add}, {"fma", counts.fma}, {"other", counts.other}};
}

Json to_json(const graph::Spills& spills) { return {{"stores", spills.stores}, {"reloads", spills.reloads}}; }

Json to_json(const graph::Kernel& kernel) {
    const graph::Cost cost = graph::count_operations(kernel);
    const std::vector<graph::Statement> statements = graph::schedule(kernel);
    Json json = to_json(cost.total());
    json["multiplications"] = cost.total().multiplications();
    json["instructions"] = cost.total().instructions();
    json["per_rotation"] = to_json(cost.per_rotation);
    json["per_vector"] = to_json(cost.per_vector);
    if (kernel.name.starts_with("rotate")) json["cycles"] = graph::call_cycles(kernel);
    json["peak_live_values"] = graph::peak_live_values(kernel, statements);
    json["spills"] = {{"16", to_json(graph::simulate_spills(kernel, statements, 16))},
                      {"32", to_json(graph::simulate_spills(kernel, statements, 32))}};
    return json;
}

/// The method each kernel has for every band, and what the others would cost.
Json methods_to_json(int order, const kernels::OrderPlans& plans) {
    Json bands = Json::array();
    for (int l = 1; l < order; ++l) {
        Json others = Json::array();
        for (const kernels::Alternative& way : kernels::alternatives(order, l))
            others.push_back({{"method", way.method->name},
                              {"per_rotation", to_json(way.cost.per_rotation)},
                              {"per_vector", to_json(way.cost.per_vector)}});
        bands.push_back({{"band", l},
                         {"rotate_fewest", plans.one[l - 1]->name},
                         {"rotate_channels", plans.channels[l - 1]->name},
                         {"apply", plans.many[l - 1]->name},
                         {"alternatives", others}});
    }
    return bands;
}

/// What `rotate` is.
Json to_json(const kernels::RotateChoice& choice) {
    return {{"one_channel", choice.one}, {"several_channels", choice.channels}};
}

/// Bands 2 … N-1.
Json to_json(const std::vector<TablePointer>& per_band) {
    Json bands = Json::array();
    for (const TablePointer& source : per_band) {
        const LobeTable& table = source->table;
        const graph::Counts counts = kernels::factorization_counts(table.bands.front());
        bands.push_back({{"band", table.use.value},
                         {"table", source->name},
                         {"zeros", table.zeros[0]},
                         {"multiplications", counts.multiplications()},
                         {"instructions", counts.instructions()},
                         {"cond", table.condition[0]}});
    }
    return bands;
}

Json to_json(const OrderKernels& order) {
    Json json{{"order", order.order}};
    const OrderTables& tables = order.tables;
    if (tables.shared) {
        const LobeTable& table = tables.shared->table;
        Json bands = Json::array();
        for (int l = 0; l < order.order; ++l)
            bands.push_back(
                {{"band", l},
                 {"entries", (2 * l + 1) * (2 * l + 1)},
                 {"zeros", table.zeros[l]},
                 {"multiplications", kernels::factorization_counts(table.bands[l]).multiplications()},
                 {"cond", table.condition[l]}});
        json["table"] = tables.shared->name;
        json["nonzeros"] = table.nonzeros;
        json["bands"] = bands;
        const LobeTable& turned = tables.rotate_zhf->table;
        json["rotate_zhf"] = {{"table", tables.rotate_zhf->name},
                              {"nonzeros", turned.nonzeros},
                              {"cond", std::ranges::max(turned.condition)}};
    }
    if (!tables.per_band.empty()) json["per_band"] = to_json(tables.per_band);
    json["methods"] = methods_to_json(order.order, order.plans);
    const std::map<std::string, Bound> bounds = published_bounds(order);
    const kernels::RotateChoice on_cpu = chosen_rotate(order, bounds, kernels::Processor::cpu);
    json["rotate"] = {{"cpu", to_json(on_cpu)},
                      {"gpu", to_json(chosen_rotate(order, bounds, kernels::Processor::gpu))}};
    Json& counted = json["kernels"];
    counted["rotate"] = to_json(kernels::make_rotate(order.kernels, on_cpu));
    for (const graph::Kernel& kernel : order.kernels) counted[kernel.full_name()] = to_json(kernel);
    return json;
}

void print_table(const Json& stats) {
    if (stats.contains("bands")) {
        fmt::print("{:<6}{:>9}{:>8}{:>17}{:>12}\n", "band", "entries", "zeros", "multiplications", "cond");
        for (const Json& band : stats["bands"])
            fmt::print("{:<6}{:>9}{:>8}{:>17}{:>12.4g}\n", band["band"].get<int>(),
                       band["entries"].get<int>(), band["zeros"].get<int>(),
                       band["multiplications"].get<int>(), band["cond"].get<double>());
        fmt::print("\n");
    }
    fmt::print("{:<6}{}\n", "band", "method of rotate_fewest");
    for (const Json& band : stats["methods"])
        fmt::print("{:<6}{}\n", band["band"].get<int>(), band["rotate_fewest"].get<std::string>());
    fmt::print("\n{:<20}{:>6}{:>6}{:>6}{:>7}   {}\n", "kernel", "mul", "add", "fma", "other",
               "of these once per rotation (mul add fma other)");
    for (const auto& [name, kernel] : stats["kernels"].items()) {
        const Json& once = kernel["per_rotation"];
        fmt::print("{:<20}{:>6}{:>6}{:>6}{:>7}   {} {} {} {}\n", name, kernel["mul"].get<int>(),
                   kernel["add"].get<int>(), kernel["fma"].get<int>(), kernel["other"].get<int>(),
                   once["mul"].get<int>(), once["add"].get<int>(), once["fma"].get<int>(),
                   once["other"].get<int>());
    }
}

}  // namespace

void add_stats_command(CLI::App& app) {
    CLI::App* command = app.add_subcommand("stats", "count the operations of every kernel of an order");
    const auto options = std::make_shared<StatsOptions>();
    program::add_number(*command, "--order", options->order, program::from_to(kSmallestOrder, kLargestOrder),
                        "number of bands")
        ->required();
    command
        ->add_option("--table", options->table,
                     "lobe table to take for what its field `for` names (default: those of the folder of "
                     "tables)")
        ->check(program::not_empty());
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
