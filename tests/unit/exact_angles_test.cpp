#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "exact/angles.hpp"

namespace zonal::exact {
namespace {

const Real kAngleTolerance{"1e-48"};

const Real kPi = pi();

TEST(ClosedForm, reads_the_forms_that_tables_use) {
    EXPECT_EQ(evaluate_closed_form("0"), 0);
    EXPECT_LT(abs(evaluate_closed_form("pi/2") - kPi / 2), kAngleTolerance);
    EXPECT_LT(abs(evaluate_closed_form("3*pi/8") - 3 * kPi / 8), kAngleTolerance);
    EXPECT_LT(abs(evaluate_closed_form("acos(sqrt(3/7))") - acos(sqrt(Real(3) / 7))), kAngleTolerance);
    EXPECT_LT(abs(evaluate_closed_form("acos(sqrt((15-2*sqrt(30))/35))") -
                  acos(sqrt((15 - 2 * sqrt(Real(30))) / 35))),
              kAngleTolerance);
}

TEST(ClosedForm, keeps_every_digit_of_a_decimal) {
    const std::string digits = "1.2345678901234567890123456789012345678901234567891";
    EXPECT_EQ(decimal_text(evaluate_closed_form(digits)), digits);
}

TEST(ClosedForm, reads_what_is_written_of_small_angles) {
    for (const char* text : {"5e-05", "1.25e-41", "3e+20"})
        EXPECT_EQ(decimal_text(evaluate_closed_form(text)), decimal_text(Real{text}));
    EXPECT_EQ(evaluate_closed_form(decimal_text(Real{"2.5e-7"})), Real{"2.5e-7"});
}

TEST(ClosedForm, multiplies_before_adding_and_groups_from_the_left) {
    EXPECT_EQ(evaluate_closed_form("1 + 2*3"), 7);
    EXPECT_EQ(evaluate_closed_form("10 - 4 - 3"), 3);
    EXPECT_EQ(evaluate_closed_form("12/3/2"), 2);
    EXPECT_EQ(evaluate_closed_form("-(2+3)*2"), -10);
}

TEST(ClosedForm, quotes_what_it_cannot_read) {
    for (const char* text :
         {"", "pi/", "sqrt(2", "cos(1)", "1..2", "1e", "1/0", "acos(2)", "sqrt(-1)", "pi pi"}) {
        try {
            evaluate_closed_form(text);
            ADD_FAILURE() << "read \"" << text << '"';
        } catch (const std::invalid_argument& error) {
            EXPECT_THAT(error.what(), testing::HasSubstr('"' + std::string(text) + '"'));
            EXPECT_THAT(error.what(), testing::HasSubstr("character"));
        }
    }
}

TEST(ClosedForm, what_would_take_forever_or_all_memory_is_refused) {
    for (const std::string& text : {std::string("1e999999999"), std::string("1e-99999"),
                                    std::string(100000, '(') + "1" + std::string(100000, ')'),
                                    std::string(100000, '-') + "1", std::string(1000000, '7')})
        EXPECT_THROW(evaluate_closed_form(text), std::invalid_argument) << text.substr(0, 20);
    for (const char* text :
         {"1e999999999", "1e-2147483649", "nan", "inf", "0x10", "", ".", "1e", "1 ", "--1"})
        EXPECT_THROW(Real{text}, std::runtime_error) << text;
    EXPECT_EQ(Real{"-.5e+1"}, -5);
}

TEST(DirectionOf, coordinate_planes_have_exact_zeros) {
    const Direction<Real> x = direction_of(kPi / 2, Real(0));
    EXPECT_EQ(x(1), 0);
    EXPECT_EQ(x(2), 0);
    const Direction<Real> minus_y = direction_of(kPi / 2, 3 * kPi / 2);
    EXPECT_EQ(minus_y(0), 0);
    EXPECT_LT(abs(minus_y(1) + 1), kAngleTolerance);
}

}  // namespace
}  // namespace zonal::exact
