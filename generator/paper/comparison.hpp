#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

namespace zonal::paper {

using Json = nlohmann::ordered_json;

/// Every function below gives an array of objects, with null where the folder lacks a table; a table that is
/// there but not as it should be throws `UserError`.

/// Table I, upper part, l = 2 … 6: {band, paper, ours, ratio}, both with the lobes of y_l^{-l} … y_l^l; the
/// ratio is that of their sums.
Json lobes_of_functions(const std::filesystem::path& tables);

/// Table I, lower part, l = 2 … 18: {band, entries, paper_percent, zeros, percent, cond, ratio}.
Json zeros_of_bands(const std::filesystem::path& tables);

/// Table II for one order: {order, paper, ours, ratio}. `ours` counts the kernels as they are emitted,
/// `sparse` the nonzeros of bands from 2 on; ratios are ours over the paper's, `rotate` over the least of the
/// paper's rows, zxzxz with optimized z-rotations included.
Json multiplications(const std::filesystem::path& tables, int order);

/// Figure 3 for one order: {order, random, drawn, searched_percent, paper, ratio}; the ratio is of the
/// searched ones, null at orders that the paper has no value for.
Json sparsity(const std::filesystem::path& tables, int order, int sets, std::uint64_t seed);

/// Eq. 8 for one band: {band, paper_seconds, seconds, ratio, residual, rounding, evaluations, starts}.
Json expansion(int l, std::uint64_t seed);

/// All of it. `on_step` is told what comes next.
Json compare(const std::filesystem::path& tables, int sets, std::uint64_t seed,
             const std::function<void(const std::string&)>& on_step);

}  // namespace zonal::paper
