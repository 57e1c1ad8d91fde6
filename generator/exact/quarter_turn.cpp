#include "exact/quarter_turn.hpp"

#include <Eigen/LU>

#include "exact/spherical_harmonics.hpp"

namespace zonal::exact {

namespace {

/// 2l+1 directions that determine a band well: a spiral that no half turn maps onto itself (one that a half
/// turn does determines no odd band).
std::vector<Direction<Real>> spiral(int count) {
    std::vector<Direction<Real>> directions;
    const Real golden_angle_rad = pi() * (3 - sqrt(Real(5)));
    for (int d = 0; d < count; ++d) {
        const Real z = 1 - (2 * d + Real(0.5)) / count;
        const Real radius = sqrt(1 - z * z);
        const Real azimuth_rad = d * golden_angle_rad;
        directions.emplace_back(radius * cos(azimuth_rad), radius * sin(azimuth_rad), z);
    }
    return directions;
}

}  // namespace

Matrix<Real> quarter_turn(int l) {
    // f'(ω) = f(Qᵀω) at the directions of the spiral: Y X = Y_turned, with Qᵀ (x, y, z) = (x, -z, y).
    const std::vector<Direction<Real>> directions = spiral(2 * l + 1);
    std::vector<Direction<Real>> turned;
    for (const Direction<Real>& w : directions) turned.emplace_back(w(0), -w(2), w(1));
    Matrix<Real> x = band_matrix<Real>(l, directions).partialPivLu().solve(band_matrix<Real>(l, turned));
    set_small_to_zero(x);
    return x;
}

std::vector<QuarterTurnBlock> quarter_turn_blocks(int l) {
    const Matrix<Real> x = quarter_turn(l);
    std::vector<QuarterTurnBlock> blocks;
    for (const auto& [first, step] : {std::pair{1, 2}, {-1, -2}, {0, 2}, {-2, -2}}) {
        QuarterTurnBlock block;
        for (int m = first; std::abs(m) <= l; m += step) block.columns.push_back(m);
        for (int size = 0; size <= l; ++size) {
            for (const int m : {-size, size}) {
                if (m == 0 && !block.rows.empty()) continue;
                bool is_used = false;
                for (const int column : block.columns) is_used = is_used || x(l + m, l + column) != 0;
                if (is_used) block.rows.push_back(m);
            }
        }
        block.matrix.resize(block.rows.size(), block.columns.size());
        for (int i = 0; i < block.matrix.rows(); ++i)
            for (int j = 0; j < block.matrix.cols(); ++j)
                block.matrix(i, j) = x(l + block.rows[i], l + block.columns[j]);
        if (!block.columns.empty()) blocks.push_back(block);
    }
    return blocks;
}

}  // namespace zonal::exact
