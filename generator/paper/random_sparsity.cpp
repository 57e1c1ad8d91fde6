#include "paper/random_sparsity.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "search/score.hpp"

namespace zonal::paper {
namespace {

constexpr int kDrawsOfASet = 20;

double at_rank(const std::vector<double>& sorted, double fraction) {
    const double rank = fraction * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(rank);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return std::lerp(sorted[below], sorted[above], rank - static_cast<double>(below));
}

}  // namespace

Distribution distribution_of(std::vector<double> values) {
    if (values.empty()) return {};
    std::ranges::sort(values);
    const double sum = std::accumulate(values.begin(), values.end(), 0.0);
    return {static_cast<int>(values.size()),
            sum / static_cast<double>(values.size()),
            values.front(),
            at_rank(values, 0.25),
            at_rank(values, 0.5),
            at_rank(values, 0.75),
            values.back()};
}

int entries_of_order(int order) { return order * (4 * order * order - 1) / 3 - 10; }

std::optional<double> sparsity_of(const search::CandidateGrid& grid, int order,
                                  const search::LobeSet& lobes) {
    Eigen::Index zeros = 0;
    for (int l = 1; l < order; ++l) {
        const int size = 2 * l + 1;
        exact::Matrix<double> columns(size, size);  // Y transposed
        for (int d = 0; d < size; ++d) grid.evaluate(l, lobes[d], columns.col(d).data());
        const exact::Matrix<double> a_hat = columns.inverse();
        if (!(a_hat.squaredNorm() < search::kSingularSquaredNorm)) return std::nullopt;
        if (l >= 2) zeros += (a_hat.array().abs() < search::kZeroInDouble).count();
    }
    return 100.0 * static_cast<double>(zeros) / entries_of_order(order);
}

RandomSparsity random_sparsity(int order, int sets, std::uint64_t seed) {
    const search::CandidateGrid grid(order - 1);
    search::Random random(seed, order);
    std::vector<double> values;
    RandomSparsity result;
    while (static_cast<int>(values.size()) < sets && result.drawn < kDrawsOfASet * sets) {
        ++result.drawn;
        search::LobeSet lobes;
        for (int d = 0; d < 2 * order - 1; ++d) lobes.push_back(grid.random(random));
        if (const auto sparsity = sparsity_of(grid, order, lobes)) values.push_back(*sparsity);
    }
    result.distribution = distribution_of(values);
    return result;
}

}  // namespace zonal::paper
