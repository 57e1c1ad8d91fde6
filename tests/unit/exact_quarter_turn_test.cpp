#include <gtest/gtest.h>

#include "exact/orthogonal_block.hpp"
#include "exact/quarter_turn.hpp"
#include "exact/spherical_harmonics.hpp"

namespace zonal::exact {
namespace {

const Real kBlockTolerance{"1e-40"};

Real distance_from_identity(const Matrix<Real>& matrix) {
    return (matrix - Matrix<Real>::Identity(matrix.rows(), matrix.cols())).norm();
}

TEST(QuarterTurn, takes_the_harmonics_to_those_with_y_as_polar_axis) {
    // Column l+m: y_l^m of the directions turned back, which takes (x, y, z) to (x, -z, y).
    const Real x = Real(2) / 7, y = Real(3) / 7, z = Real(6) / 7;
    for (int l = 0; l < 20; ++l) {
        const Vector<Real> turned = evaluate_band<Real>(l, {x, -z, y});
        const Vector<Real> values = quarter_turn(l).transpose() * evaluate_band<Real>(l, {x, y, z});
        EXPECT_LT((turned - values).norm(), kBlockTolerance) << "band " << l;
    }
}

TEST(QuarterTurn, squares_of_entries_are_multiples_of_a_power_of_a_quarter) {
    for (int l = 1; l < 20; ++l) {
        const Matrix<Real> x = quarter_turn(l);
        for (const Real& entry : x.reshaped()) {
            const Real scaled = entry * entry * pow(Real(4), l - 1);
            EXPECT_LT(abs(scaled - round(scaled)), Real("1e-30")) << "band " << l;
        }
    }
}

TEST(QuarterTurn, blocks_hold_every_entry_that_is_not_zero) {
    for (int l = 1; l < 20; ++l) {
        Real inside = 0;
        for (const QuarterTurnBlock& block : quarter_turn_blocks(l)) {
            EXPECT_EQ(block.rows.size(), block.columns.size()) << "band " << l;
            EXPECT_LT(distance_from_identity(block.matrix * block.matrix.transpose()), kBlockTolerance);
            inside += block.matrix.squaredNorm();
        }
        EXPECT_LT(abs(inside - (2 * l + 1)), kBlockTolerance) << "band " << l;
    }
}

TEST(QuarterTurn, block_of_band_5_has_the_entries_of_its_closed_form) {
    // Squares in 256ths, rows and columns 1, 3, 5: 4 42 210; 42 169 45; 210 45 1.
    const QuarterTurnBlock block = quarter_turn_blocks(5).front();
    const int squares[3][3] = {{4, 42, 210}, {42, 169, 45}, {210, 45, 1}};
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            EXPECT_LT(abs(block.matrix(i, j) * block.matrix(i, j) * 256 - squares[i][j]), kBlockTolerance);
}

TEST(OrthogonalBlock, steps_make_the_matrix_again) {
    for (int l = 1; l < 20; ++l) {
        for (const QuarterTurnBlock& block : quarter_turn_blocks(l)) {
            const BlockSteps steps = factorize_orthogonal(block.matrix);
            EXPECT_LT((multiplied_out(steps) - block.matrix).norm(), kBlockTolerance) << "band " << l;
        }
    }
}

TEST(OrthogonalBlock, costs_less_than_the_product) {
    const auto cost = [](int l, int block) {
        return instructions(factorize_orthogonal(quarter_turn_blocks(l)[block].matrix));
    };
    EXPECT_EQ(cost(3, 0), 3);   // 2 x 2 by lifting, not 4
    EXPECT_EQ(cost(5, 0), 5);   // symmetric 3 x 3, not 9
    EXPECT_EQ(cost(5, 1), 8);   // 3 x 3 by shears
    EXPECT_EQ(cost(7, 1), 15);  // 4 x 4 by shears, not 16
    EXPECT_EQ(cost(7, 0), 12);  // symmetric 4 x 4 of rank 2
}

TEST(OrthogonalBlock, no_shear_has_a_factor_above_1) {
    for (int l = 1; l < 20; ++l) {
        for (const QuarterTurnBlock& block : quarter_turn_blocks(l)) {
            const BlockSteps steps = factorize_orthogonal(block.matrix);
            for (const BlockStep& step : steps.steps) {
                if (const auto* shear = std::get_if<Shear>(&step)) {
                    EXPECT_LE(shear->factors.cwiseAbs().maxCoeff(), Real(1)) << "band " << l;
                }
            }
        }
    }
}

Matrix<Real> with_scaled_columns(Matrix<Real> matrix, const std::vector<Real>& scales) {
    for (int j = 0; j < matrix.cols(); ++j) matrix.col(j) *= scales[j];
    return matrix;
}

TEST(ScaledBlocks, steps_make_the_matrices_with_scaled_columns) {
    for (int l = 2; l < 12; ++l) {
        const auto blocks = quarter_turn_blocks(l);
        for (const auto& group : {std::vector{blocks[0].matrix, blocks[1].matrix}, {blocks[3].matrix}}) {
            const ScaledBlocks scaled = factorize_up_to_scales(group);
            ASSERT_EQ(scaled.blocks.size(), group.size());
            for (std::size_t k = 0; k < group.size(); ++k) {
                const Matrix<Real> expected = with_scaled_columns(group[k], scaled.scales);
                EXPECT_LT((multiplied_out(scaled.blocks[k]) - expected).norm(), kBlockTolerance)
                    << "band " << l;
            }
        }
    }
}

TEST(ScaledBlocks, save_a_factor_a_column_but_one) {
    const auto costs = [](const std::vector<Matrix<Real>>& matrices) {
        std::vector<int> all;
        for (const BlockSteps& block : factorize_up_to_scales(matrices).blocks)
            all.push_back(instructions(block));
        return all;
    };
    const auto band_3 = quarter_turn_blocks(3), band_5 = quarter_turn_blocks(5),
               band_6 = quarter_turn_blocks(6);
    EXPECT_EQ(costs({band_5[3].matrix}), std::vector{2});  // 2 x 2, without scales 3
    EXPECT_EQ(costs({band_6[3].matrix}), std::vector{6});  // 3 x 3, without scales 8
    // Scales serve one of two blocks.
    const auto both = costs({band_3[0].matrix, band_3[1].matrix});
    EXPECT_EQ(both[0] + both[1], 5);
}

TEST(ScaledBlocks, neither_scales_nor_factors_are_large) {
    for (int l = 2; l < 12; ++l) {
        const ScaledBlocks scaled = factorize_up_to_scales({quarter_turn_blocks(l)[3].matrix});
        for (const Real& scale : scaled.scales) {
            EXPECT_GE(scale, Real(0.5)) << "band " << l;
            EXPECT_LE(scale, Real(2)) << "band " << l;
        }
        for (const BlockStep& step : scaled.blocks[0].steps) {
            if (const auto* shear = std::get_if<Shear>(&step)) {
                EXPECT_LE(shear->factors.cwiseAbs().maxCoeff(), Real(1)) << "band " << l;
            }
        }
    }
}

}  // namespace
}  // namespace zonal::exact
