#include <gtest/gtest.h>

#include <set>

#include "exact/angles.hpp"
#include "exact/spherical_harmonics.hpp"
#include "search/candidates.hpp"
#include "search/closed_form_zeros.hpp"

namespace zonal::search {
namespace {

using exact::Real;

const Real kCandidateTolerance{"1e-47"};

bool has_text(const std::vector<Angle>& angles, const std::string& text) {
    return std::ranges::any_of(angles, [&](const Angle& angle) { return angle.text == text; });
}

TEST(Candidates, texts_evaluate_to_their_angles) {
    const CandidateGrid grid(8);
    for (const auto* angles : {&grid.thetas(), &grid.phis()}) {
        for (const Angle& angle : *angles) {
            EXPECT_LT(abs(exact::evaluate_closed_form(angle.text) - angle.value), kCandidateTolerance)
                << angle.text;
        }
    }
}

TEST(Candidates, closed_forms_are_in_lowest_terms) {
    const CandidateGrid grid(5);
    for (const char* text : {"0", "pi/2", "acos(sqrt(1/3))", "acos(sqrt(3/5))", "acos(sqrt(3/7))",
                             "acos(sqrt((15-2*sqrt(30))/35))", "acos(sqrt((15+2*sqrt(30))/35))"}) {
        EXPECT_TRUE(has_text(grid.thetas(), text)) << text;
    }
    for (const char* text : {"0", "pi", "pi/2", "3*pi/2", "pi/10", "7*pi/4", "3*pi/8"}) {
        EXPECT_TRUE(has_text(grid.phis(), text)) << text;
    }
}

TEST(Candidates, hold_every_zero_once) {
    const CandidateGrid grid(6);
    for (int l = 1; l <= 6; ++l) {
        for (int m = 0; m < l; ++m) {
            for (const Angle& zero : legendre_zero_angles(l, m)) {
                const auto count = std::ranges::count_if(grid.thetas(), [&](const Angle& theta) {
                    return abs(theta.value - zero.value) < kCandidateTolerance;
                });
                EXPECT_EQ(count, 1) << zero.text;
            }
        }
    }
    // The pole, the equator, and 22 zeros, of which P_5^2 shares 1/sqrt(3) with P_2.
    EXPECT_EQ(grid.thetas().size(), 2 + 22 - 1);
}

TEST(Candidates, same_direction_up_to_sign_has_one_name) {
    CandidateGrid grid(4);
    const int pi = grid.add_phi(fraction_of_pi(1, 1));
    const int quarter = grid.add_phi(fraction_of_pi(1, 4)), opposite = grid.add_phi(fraction_of_pi(5, 4));
    EXPECT_EQ(grid.canonical(grid.pole(), quarter), grid.canonical(grid.pole(), pi));
    EXPECT_EQ(grid.canonical(grid.equator(), opposite), grid.canonical(grid.equator(), quarter));
    EXPECT_NE(grid.canonical(2, opposite), grid.canonical(2, quarter));
}

TEST(Candidates, rows_are_the_basis_at_the_direction) {
    const CandidateGrid grid(6);
    Random random(1, 0);
    for (int trial = 0; trial < 50; ++trial) {
        const Lobe lobe = grid.random(random);
        for (int l = 1; l <= 6; ++l) {
            const exact::Vector<double> wanted =
                exact::evaluate_band<Real>(l, grid.direction(lobe)).cast<double>();
            exact::Vector<double> row(2 * l + 1);
            grid.evaluate(l, lobe, row.data());
            EXPECT_LT((row - wanted).cwiseAbs().maxCoeff(), 1e-14);
        }
    }
}

TEST(Candidates, angle_off_the_grid_is_added_once) {
    CandidateGrid grid(3);
    const std::size_t before = grid.thetas().size();
    const int index = grid.add_theta({Real{"0.6"}, "0.6"});
    EXPECT_EQ(grid.add_theta({Real{"0.6"}, "0.6"}), index);
    EXPECT_EQ(grid.thetas().size(), before + 1);
}

TEST(Candidates, images_keep_the_distance_to_the_pole) {
    CandidateGrid grid(4);
    Random random(5, 0);
    std::set<Lobe> images;
    const Lobe lobe = grid.canonical(2, grid.add_phi(fraction_of_pi(1, 8)));
    for (int trial = 0; trial < 100; ++trial) images.insert(grid.random_image(lobe, random));
    EXPECT_EQ(images.size(), 8);
    for (const Lobe image : images) EXPECT_EQ(image.theta, lobe.theta);
}

TEST(Candidates, angle_beyond_the_16_bits_of_a_lobe_is_refused) {
    EXPECT_EQ(narrow_index(65535), 65535);
    EXPECT_THROW(narrow_index(65536), std::length_error);
}

}  // namespace
}  // namespace zonal::search
