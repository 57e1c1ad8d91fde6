#include "search/pattern.hpp"

#include <cmath>

#include "search/score.hpp"

namespace zonal::search {
namespace {

bool is_zero(double value) { return std::abs(value) < kZeroInDouble; }

}  // namespace

Pattern zeros_of(const std::vector<exact::Matrix<double>>& a_hats) {
    Pattern zeros;
    for (std::size_t b = 0; b < a_hats.size(); ++b) {
        for (int column = 0; column < a_hats[b].cols(); ++column) {
            for (int row = 0; row < a_hats[b].rows(); ++row) {
                if (is_zero(a_hats[b](row, column))) zeros.push_back({static_cast<int>(b), row, column});
            }
        }
    }
    return zeros;
}

Pattern nonzeros_of(const Problem& problem, const std::vector<exact::Matrix<double>>& a_hats) {
    Pattern nonzeros;
    for (std::size_t b = 0; b < a_hats.size(); ++b) {
        if (problem.bands[b] < 2) continue;
        for (int column = 0; column < a_hats[b].cols(); ++column) {
            for (int row = 0; row < a_hats[b].rows(); ++row) {
                if (!is_zero(a_hats[b](row, column))) nonzeros.push_back({static_cast<int>(b), row, column});
            }
        }
    }
    return nonzeros;
}

Pattern equalities_of(const std::vector<exact::Matrix<double>>& a_hats) {
    Pattern equalities;
    for (std::size_t b = 0; b < a_hats.size(); ++b) {
        for (int column = 0; column < a_hats[b].cols(); ++column) {
            const auto values = a_hats[b].col(column);
            for (int row = 0; row < values.size(); ++row) {
                if (is_zero(values(row))) continue;
                for (int other = 0; other < row; ++other) {
                    if (!is_zero(std::abs(values(row)) - std::abs(values(other)))) continue;
                    const int sign = values(row) * values(other) > 0 ? 1 : -1;
                    equalities.push_back({static_cast<int>(b), row, column, other, sign});
                    break;  // one partner is enough
                }
            }
        }
    }
    return equalities;
}

}  // namespace zonal::search
