#include "paper/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "graph/counts.hpp"
#include "graph/passes.hpp"
#include "kernels/lobes.hpp"
#include "kernels/planner.hpp"
#include "kernels/rotations.hpp"
#include "lobes/lobe_table.hpp"
#include "paper/published.hpp"
#include "paper/random_sparsity.hpp"
#include "search/expansion.hpp"

namespace zonal::paper {
namespace {

/// Random sets above this order are fewer, in proportion to the time each takes.
constexpr int kLargestOrderOfAllSets = 10;

std::optional<LobeTable> find_table(const std::filesystem::path& tables, const LobeUse& use) {
    const std::filesystem::path path = tables / use.table_path();
    if (!std::filesystem::exists(path)) return std::nullopt;
    return read_lobe_table(path, use);
}

int multiplications_of(const graph::Kernel& kernel) {
    return graph::count_operations(kernel).total().multiplications();
}

Json paper_multiplications(const published::Multiplications& row) {
    return {{"z_rotation", row.z_rotation},
            {"z_rotation_optimized", row.z_rotation_optimized},
            {"x_rotation", row.x_rotation},
            {"zxzxz", row.zxzxz},
            {"zxzxz_optimized", row.zxzxz_optimized()},
            {"basis", row.basis},
            {"y_product", row.y_product},
            {"sparse", row.sparse},
            {"standard_cpu", row.standard_cpu},
            {"standard_gpu", row.standard_gpu}};
}

Json our_multiplications(const std::filesystem::path& tables, int order) {
    Json ours{{"sparse", nullptr}, {"factorize", nullptr}, {"rotate_zhf", nullptr}};
    if (const auto table = find_table(tables, LobeUse::order(order))) {
        const auto lobes = kernels::LobeSet::shared(*table);
        ours["sparse"] = table->nonzeros;
        ours["factorize"] = multiplications_of(graph::optimize(kernels::build_factorize(lobes)));
        ours["rotate_zhf"] = multiplications_of(graph::optimize(kernels::build_rotate_zhf(lobes)));
    }
    ours["rotate"] = multiplications_of(kernels::build_plan(order, kernels::plan_order(order).one));
    return ours;
}

Json ratio(const Json& ours, int paper) { return ours.is_null() ? Json() : Json(ours.get<double>() / paper); }

int sets_of(int order, int sets) {
    const double share = static_cast<double>(kLargestOrderOfAllSets) / order;
    return std::max(1, static_cast<int>(sets * std::min(1.0, share * share * share * share)));
}

}  // namespace

Json lobes_of_functions(const std::filesystem::path& tables) {
    Json rows = Json::array();
    int l = 2;
    for (const std::vector<int>& paper : published::kLobesOfFunctions) {
        Json row{{"band", l}, {"paper", paper}, {"ours", nullptr}, {"ratio", nullptr}};
        if (const auto table = find_table(tables, LobeUse::band(l))) {
            const BandFactorization& band = table->bands.front();
            row["ours"] = Json::array();
            for (int m = 0; m <= 2 * l; ++m) {
                const auto lobes = band.a_hat.row(m);
                row["ours"].push_back(std::count_if(lobes.begin(), lobes.end(),
                                                    [](const exact::Real& weight) { return weight != 0; }));
            }
            row["ratio"] = ratio(table->nonzeros, std::accumulate(paper.begin(), paper.end(), 0));
        }
        rows.push_back(row);
        ++l;
    }
    return rows;
}

Json zeros_of_bands(const std::filesystem::path& tables) {
    Json rows = Json::array();
    int l = 2;
    for (const int percent : published::kZerosOfBands) {
        const int entries = (2 * l + 1) * (2 * l + 1);
        Json row{{"band", l},          {"entries", entries}, {"paper_percent", percent}, {"zeros", nullptr},
                 {"percent", nullptr}, {"cond", nullptr},    {"ratio", nullptr}};
        if (const auto table = find_table(tables, LobeUse::band(l))) {
            row["zeros"] = table->zeros.front();
            row["percent"] = 100.0 * table->zeros.front() / entries;
            row["ratio"] = ratio(row["percent"], percent);
            row["cond"] = table->condition.front();
        }
        rows.push_back(row);
        ++l;
    }
    return rows;
}

Json multiplications(const std::filesystem::path& tables, int order) {
    const published::Multiplications& paper = published::kMultiplications.at(order - 3);
    const Json ours = our_multiplications(tables, order);
    return {{"order", order},
            {"paper", paper_multiplications(paper)},
            {"ours", ours},
            {"ratio",
             {{"sparse", ratio(ours["sparse"], paper.sparse)},
              {"rotate_zhf", ratio(ours["rotate_zhf"], paper.standard_cpu)},
              {"rotate", ratio(ours["rotate"], std::min(paper.zxzxz_optimized(), paper.standard_cpu))}}}};
}

Json sparsity(const std::filesystem::path& tables, int order, int sets, std::uint64_t seed) {
    const RandomSparsity random = random_sparsity(order, sets, seed);
    const Distribution& d = random.distribution;
    Json row{{"order", order},   {"random", nullptr}, {"drawn", random.drawn}, {"searched_percent", nullptr},
             {"paper", nullptr}, {"ratio", nullptr}};
    if (d.sets > 0)
        row["random"] = {{"sets", d.sets},      {"mean", d.mean},
                         {"least", d.least},    {"lower_quartile", d.lower_quartile},
                         {"median", d.median},  {"upper_quartile", d.upper_quartile},
                         {"largest", d.largest}};
    if (const auto table = find_table(tables, LobeUse::order(order)))
        row["searched_percent"] = 100.0 - 100.0 * table->nonzeros / entries_of_order(order);
    if (order == published::kSparsity.order) {
        row["paper"] = {{"mean", published::kSparsity.random_mean},
                        {"largest", published::kSparsity.random_largest},
                        {"searched", published::kSparsity.searched}};
        row["ratio"] = ratio(row["searched_percent"], published::kSparsity.searched);
    }
    return row;
}

Json expansion(int l, std::uint64_t seed) {
    const int paper = published::kSolverSeconds.at(l - 2);
    const search::Expansion solved = search::solve_expansion(l, seed);
    return {{"band", l},
            {"paper_seconds", paper},
            {"seconds", solved.seconds},
            {"ratio", solved.seconds / paper},
            {"residual", solved.residual},
            {"rounding", search::expansion_rounding(l, solved.weights)},
            {"evaluations", solved.evaluations},
            {"starts", solved.starts}};
}

Json compare(const std::filesystem::path& tables, int sets, std::uint64_t seed,
             const std::function<void(const std::string&)>& on_step) {
    Json comparison{{"seed", seed}};
    on_step("Table I");
    comparison["lobes_of_functions"] = lobes_of_functions(tables);
    comparison["zeros_of_bands"] = zeros_of_bands(tables);
    for (const published::Multiplications& row : published::kMultiplications) {
        on_step(fmt::format("Table II, order {}", row.order));
        comparison["multiplications"].push_back(multiplications(tables, row.order));
    }
    for (const published::Multiplications& row : published::kMultiplications) {
        on_step(fmt::format("Figure 3, order {}", row.order));
        comparison["sparsity"].push_back(sparsity(tables, row.order, sets_of(row.order, sets), seed));
    }
    for (int l = 2; l < 2 + static_cast<int>(published::kSolverSeconds.size()); ++l) {
        on_step(fmt::format("eq. 8, band {}", l));
        comparison["expansion"].push_back(expansion(l, seed));
    }
    return comparison;
}

}  // namespace zonal::paper
