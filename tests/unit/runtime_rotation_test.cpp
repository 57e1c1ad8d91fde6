#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <string>

#include "zonal/eigen.hpp"
#include "zonal/error.hpp"
#include "zonal/rotation.hpp"

namespace {

using zonal::RotationMatrix;

/// Every entry different, so that a transpose or a swapped axis shows.
Eigen::Matrix3d asymmetric_rotation() {
    return Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
}

std::string message_of_check(const RotationMatrix<float>& rotation, double tolerance) {
    try {
        zonal::checked_rotation(rotation, tolerance);
    } catch (const zonal::Error& error) {
        return error.what();
    }
    return "no error";
}

TEST(runtime_rotation, default_is_identity) {
    EXPECT_EQ(RotationMatrix<float>().matrix(), Eigen::Matrix3f::Identity());
}

TEST(runtime_rotation, column_major_matrix_is_stored_row_major) {
    const Eigen::Matrix3d column_major = asymmetric_rotation();
    const RotationMatrix<double> rotation(column_major);
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            EXPECT_EQ(rotation.data()[3 * row + column], column_major(row, column));
        }
    }
}

TEST(runtime_rotation, quarter_turn_about_z_stores_the_images_of_the_axes_as_columns) {
    const RotationMatrix<double> rotation(Eigen::AngleAxisd(std::numbers::pi / 2, Eigen::Vector3d::UnitZ()));
    const double x_into_y = rotation.data()[3 * 1 + 0];  // row y, column x
    const double y_into_x = rotation.data()[3 * 0 + 1];
    EXPECT_DOUBLE_EQ(x_into_y, 1.0);
    EXPECT_DOUBLE_EQ(y_into_x, -1.0);
}

/// Rows 1 2 3, 4 5 6, 7 8 9: no rotation, but no two constructions may disagree on it.
TEST(runtime_rotation, nine_values_arrays_and_pointers_are_read_row_by_row) {
    const RotationMatrix<float> wanted(1, 2, 3, 4, 5, 6, 7, 8, 9);
    EXPECT_EQ(wanted(0, 1), 2);
    EXPECT_EQ(wanted(2, 0), 7);
    const float plain[9] = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    const std::array<float, 9> array = {1, 2, 3, 4, 5, 6, 7, 8, 9};
    EXPECT_EQ(RotationMatrix<float>(plain), wanted);
    EXPECT_EQ(RotationMatrix<float>(array), wanted);
    EXPECT_EQ(RotationMatrix<float>(std::span(array)), wanted);
    EXPECT_EQ(RotationMatrix<float>::from_row_major(array.data()), wanted);
    EXPECT_EQ(wanted.cast<double>(), RotationMatrix<double>(1, 2, 3, 4, 5, 6, 7, 8, 9));
}

TEST(runtime_rotation, quaternion_of_either_order_agrees_with_the_matrix_it_was_made_of) {
    const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
    const Eigen::Matrix3d wanted = turn.toRotationMatrix();  // by sine and cosine of the angle itself
    const Eigen::Quaterniond q(turn);
    const auto wxyz = RotationMatrix<double>::from_quaternion_wxyz(q.w(), q.x(), q.y(), q.z());
    EXPECT_LT((wxyz.matrix() - wanted).norm(), 8 * std::numeric_limits<double>::epsilon());
    EXPECT_EQ(RotationMatrix<double>::from_quaternion_xyzw(q.x(), q.y(), q.z(), q.w()), wxyz);
}

TEST(runtime_rotation, quaternion_off_by_e_in_norm_is_off_by_eight_root_two_e_at_a_half_turn) {
    const double e = 1e-6;
    const Eigen::Vector3d axis = Eigen::Vector3d(3, -2, 1).normalized();
    for (const double norm : {1 + e, 1 - e}) {
        const Eigen::Vector3d v = norm * axis;
        const auto r = RotationMatrix<double>::from_quaternion_wxyz(0, v.x(), v.y(), v.z());
        EXPECT_NEAR(zonal::orthonormality_error(r), 8 * std::sqrt(2.0) * e, 100 * e * e);
    }
}

TEST(runtime_rotation, expression_is_accepted) {
    const Eigen::Matrix3d m = asymmetric_rotation();
    EXPECT_EQ(RotationMatrix<double>(m.transpose()).matrix(), m.transpose().eval());
}

TEST(runtime_rotation, quaternion_agrees_with_its_matrix) {
    const Eigen::Quaterniond q(asymmetric_rotation());
    EXPECT_EQ(RotationMatrix<double>(q).matrix(), q.toRotationMatrix());
}

TEST(runtime_rotation, double_values_are_rounded_to_float) {
    const Eigen::Matrix3d m = asymmetric_rotation();
    EXPECT_EQ(RotationMatrix<float>(m).matrix(), m.cast<float>());
}

TEST(runtime_rotation, orthonormality_error_of_one_stretched_axis_is_known) {
    // R = diag(1 + e, 1, 1) has R R^T - I = diag(2 e + e^2, 0, 0); e is a power of two, so nothing is
    // rounded.
    const double e = 0x1p-10;
    const RotationMatrix<double> stretched(Eigen::Vector3d(1 + e, 1, 1).asDiagonal().toDenseMatrix());
    EXPECT_EQ(zonal::orthonormality_error(stretched), 2 * e + e * e);
}

TEST(runtime_rotation, orthonormality_error_sees_a_shear_in_both_rows) {
    // R = I + e E_01: R R^T - I has e^2 at (0, 0) and e at (0, 1) and (1, 0).
    const double e = 0x1p-10;
    Eigen::Matrix3d shear = Eigen::Matrix3d::Identity();
    shear(0, 1) = e;
    const double exact = std::sqrt(2 * e * e + e * e * e * e);
    EXPECT_NEAR(zonal::orthonormality_error(RotationMatrix<double>(shear)), exact, 1e-15);
}

TEST(runtime_rotation, rounded_rotation_passes_two_epsilons) {
    // The bound derived at checked_rotation: sqrt(3) epsilon to first order.
    const RotationMatrix<float> rotation(asymmetric_rotation());
    const double tolerance = 2.0 * std::numeric_limits<float>::epsilon();
    EXPECT_EQ(zonal::checked_rotation(rotation, tolerance).matrix(), rotation.matrix());
}

TEST(runtime_rotation, stretched_matrix_is_refused_with_the_error_measured) {
    const RotationMatrix<float> stretched(Eigen::Vector3f(1.5F, 1, 1).asDiagonal().toDenseMatrix());
    const std::string message = message_of_check(stretched, 1e-3);
    EXPECT_NE(message.find("found 1.25"), std::string::npos) << message;
    EXPECT_NE(message.find("at most 0.001"), std::string::npos) << message;
    EXPECT_NE(message.find("orthonormalise"), std::string::npos) << message;
}

TEST(runtime_rotation, error_that_a_message_names_is_accepted_as_tolerance) {
    for (int k = 1; k <= 20; ++k) {
        const float stretch = 1 + static_cast<float>(k) / 77;
        const RotationMatrix<float> stretched(Eigen::Vector3f(stretch, 1, 1).asDiagonal().toDenseMatrix());
        const std::string message = message_of_check(stretched, 1e-6);
        const double error = std::stod(message.substr(message.find("found ") + 6));
        EXPECT_EQ(message_of_check(stretched, error), "no error") << message;
    }
}

TEST(runtime_rotation, value_that_is_not_finite_is_refused_by_place) {
    Eigen::Matrix3f m = Eigen::Matrix3f::Identity();
    m(1, 2) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_NE(message_of_check(RotationMatrix<float>(m), 1e9).find("row 1, column 2: found nan"),
              std::string::npos);
    m(1, 2) = -std::numeric_limits<float>::infinity();
    EXPECT_NE(message_of_check(RotationMatrix<float>(m), 1e9).find("row 1, column 2: found -inf"),
              std::string::npos);
}

TEST(runtime_rotation, tolerance_that_is_not_a_number_accepts_nothing) {
    EXPECT_NE(message_of_check(RotationMatrix<float>(), std::nan("")), "no error");
}

TEST(runtime_rotation, mirror_is_recognised_and_accepted) {
    const Eigen::Matrix3d mirror = asymmetric_rotation() * Eigen::Vector3d(1, 1, -1).asDiagonal();
    EXPECT_TRUE(zonal::is_mirror(RotationMatrix<double>(mirror)));
    EXPECT_FALSE(zonal::is_mirror(RotationMatrix<double>(asymmetric_rotation())));
    EXPECT_NO_THROW(zonal::checked_rotation(RotationMatrix<double>(mirror), 1e-14));
}

}  // namespace
