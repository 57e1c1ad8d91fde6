#include "search/score.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace zonal::search {
namespace {

/// Distinct |values| of each column and how often the commonest occurs: `is_equal(a, b)` of two |values|.
template <class S, class IsEqual>
BandCost count(const S* a_hat, int size, const S& zero, IsEqual is_equal) {
    using std::abs;
    BandCost cost;
    std::vector<S> factors;  // of the whole band
    for (int column = 0; column < size; ++column) {
        const std::size_t first = factors.size();
        for (int row = 0; row < size; ++row) {
            const S value = abs(a_hat[column * size + row]);
            if (value < zero) continue;
            ++cost.nonzeros;
            const bool is_known = std::any_of(factors.begin() + first, factors.end(),
                                              [&](const S& factor) { return is_equal(factor, value); });
            if (!is_known) factors.push_back(value);
        }
    }
    std::sort(factors.begin(), factors.end());
    int commonest = 0, run = 0;
    for (std::size_t i = 0; i < factors.size(); ++i) {
        run = i > 0 && is_equal(factors[i - 1], factors[i]) ? run + 1 : 1;
        commonest = std::max(commonest, run);
    }
    cost.multiplications = static_cast<int>(factors.size()) - commonest;
    return cost;
}

}  // namespace

BandCost band_cost(const double* a_hat, int size) {
    return count(a_hat, size, kZeroInDouble,
                 [](double a, double b) { return std::abs(a - b) < kZeroInDouble * std::max(a, b); });
}

BandCost band_cost(const exact::Matrix<exact::Real>& a_hat) {
    return count(
        a_hat.data(), static_cast<int>(a_hat.rows()), exact::kZeroThreshold,
        [](const exact::Real& a, const exact::Real& b) { return abs(a - b) < exact::kZeroThreshold; });
}

double Score::cost(const Objective& objective) const {
    if (is_singular()) return std::numeric_limits<double>::infinity();
    double counted = objective.condition_weight * std::log2(condition);
    for (const auto& [l, cost] : bands) counted += objective.cost_of_band(l, cost);
    constexpr double kWorseThanAnyAllowed = 1e6;
    return is_allowed(objective) ? counted : counted + kWorseThanAnyAllowed;
}

namespace {

/// Adds one band to a score.
void add_band(Score& total, int l, const BandCost& cost, double condition, double norm) {
    const int size = 2 * l + 1;
    total.zeros += size * size - cost.nonzeros;
    if (l >= 2) total.nonzeros += cost.nonzeros;
    total.bands.emplace_back(l, cost);
    total.multiplications += cost.multiplications;
    total.condition = std::max(total.condition, condition);
    total.norm = std::max(total.norm, norm);
}

Score nothing_yet() {
    Score total;
    total.condition = total.norm = 0;
    return total;
}

}  // namespace

Score score(const Problem& problem, const CandidateGrid& grid, const LobeSet& lobes) {
    Score total = nothing_yet();
    for (const int l : problem.bands) {
        const int size = 2 * l + 1;
        exact::Matrix<double> columns(size, size);  // Y transposed, so that a lobe is contiguous
        for (int d = 0; d < size; ++d) grid.evaluate(l, lobes[d], columns.col(d).data());
        const exact::Vector<double> singular_values = exact::singular_values(columns);
        const double largest = singular_values(0), smallest = singular_values(size - 1);
        if (!(smallest > 1e-7 * largest)) return Score{};
        const exact::Matrix<double> a_hat = columns.transpose().inverse();
        add_band(total, l, band_cost(a_hat.data(), size), largest / smallest, 1 / smallest);
    }
    return total;
}

Score exact_score(const Problem& problem, const std::vector<exact::Direction<exact::Real>>& directions) {
    Score total = nothing_yet();
    for (const int l : problem.bands) {
        const BandFactorization band = factorize_band(l, directions);
        if (!std::isfinite(band.condition)) return Score{};
        add_band(total, l, band_cost(band.a_hat), band.condition,
                 exact::singular_values(band.a_hat.cast<double>())(0));
    }
    return total;
}

int turning_cost(const std::vector<exact::Direction<exact::Real>>& directions) {
    int cost = 0;
    for (const auto& direction : directions) {
        for (const exact::Real& component : direction) cost += component != 0 && abs(component) != 1;
    }
    return cost;
}

}  // namespace zonal::search
