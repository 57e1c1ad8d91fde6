// What every program does in the same way: numbers, text on the terminal, standard streams.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "program/numbers.hpp"
#include "program/shown.hpp"

namespace zonal::program {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

TEST(Numbers, zeros_in_front_do_not_change_the_base) {
    EXPECT_EQ(number_in<int>("010"), 10);
    EXPECT_EQ(number_in<std::uint64_t>("0018"), 18U);
    EXPECT_EQ(number_in<double>("007.50"), 7.5);
}

TEST(Numbers, whole_texts_of_decimals_alone_are_read) {
    for (const char* text : {"", " 3", "3 ", "+3", "3x", "0x10", "3.0", "1e2", "5000000000", "-5000000000"})
        EXPECT_EQ(number_in<int>(text), std::nullopt) << text;
    for (const char* text : {"", "nan", "-nan", "inf", "-infinity", "1e999", "0x1p3", "1,5", "1 "})
        EXPECT_EQ(number_in<double>(text), std::nullopt) << text;
    for (const char* text : {"-1", "18446744073709551616", "1.0"})
        EXPECT_EQ(number_in<std::uint64_t>(text), std::nullopt) << text;
    EXPECT_EQ(number_in<std::uint64_t>("18446744073709551615"), ~std::uint64_t{0});
}

TEST(Numbers, limits_are_kept_and_said_in_few_words) {
    EXPECT_EQ(number_in("3", from_to(3, 20)), 3);
    EXPECT_EQ(number_in("21", from_to(3, 20)), std::nullopt);
    EXPECT_EQ(number_in("0", above(0, 1)), std::nullopt);
    EXPECT_EQ(number_in("1", above(0, 1)), 1.0);
    EXPECT_EQ(complaint("3x", from_to(3, 20)), "found '3x', wanted a whole number from 3 to 20");
    EXPECT_EQ(at_least(1).text(), "a whole number, at least 1");
    EXPECT_EQ(above(0, 1e9).text(), "a number above 0, at most 1000000000");
    EXPECT_EQ(Limits<double>{}.text(), "a number");
    EXPECT_EQ(Limits<int>{}.text(), "a whole number");
}

TEST(Numbers, several_follow_one_option_or_each_its_own) {
    const auto read = [](std::vector<const char*> words) {
        CLI::App app;
        std::vector<int> orders;
        bool is_flagged = false;
        add_numbers(app, "--orders", orders, from_to(3, 20), "some orders");
        app.add_flag("--flag", is_flagged);
        words.insert(words.begin(), "program");
        app.parse(static_cast<int>(words.size()), words.data());
        EXPECT_TRUE(is_flagged);
        return orders;
    };
    EXPECT_THAT(read({"--orders", "3", "4", "20", "--flag"}), testing::ElementsAre(3, 4, 20));
    EXPECT_THAT(read({"--flag", "--orders", "5"}), testing::ElementsAre(5));
    EXPECT_THAT(read({"--orders", "3", "--flag", "--orders", "4"}), testing::ElementsAre(3, 4));
    EXPECT_THROW(read({"--flag", "--orders", "3", "2"}), CLI::ValidationError);
}

TEST(Shown, what_would_act_on_a_terminal_is_written_out) {
    EXPECT_EQ(shown("plain … text"), "plain … text");
    EXPECT_EQ(shown("a\nb\x1b[31m\x7f"), "a\\x0ab\\x1b[31m\\x7f");
    EXPECT_EQ(shown("\xc2\x9b"), "\\xc2\\x9b");           // a control character of two bytes
    EXPECT_EQ(shown("\xe2\x80\xae"), "\\xe2\\x80\\xae");  // right to left from here
    EXPECT_EQ(shown("\xff\xc0\x80"), "\\xff\\xc0\\x80");  // no UTF-8
    EXPECT_EQ(shown("\xe2\x80"), "\\xe2\\x80");           // cut off
}

struct Outcome {
    int status = 0;
    std::string error;
};

/// `zonal-gen` with redirections of standard output behind the arguments.
Outcome zonal_gen(const std::string& arguments) {
    const fs::path log = fs::path(testing::TempDir()) / fmt::format("zonal_program_{}", getpid());
    const int status = std::system(fmt::format("'{}' {} 2>'{}'", ZONAL_GEN, arguments, log.string()).c_str());
    std::ifstream stream(log);
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, {std::istreambuf_iterator<char>(stream), {}}};
}

TEST(StandardOutput, what_did_not_arrive_is_an_error) {
    for (const char* command : {"--help", "stats --order 3", "stats --order 3 --json"})
        for (const char* nowhere : {">/dev/full", ">&-"}) {
            const Outcome result = zonal_gen(fmt::format("{} {}", command, nowhere));
            EXPECT_EQ(result.status, 1) << command << nowhere;
            EXPECT_THAT(result.error, StartsWith("error: standard output: cannot write: "))
                << command << nowhere;
        }
}

TEST(StandardOutput, a_file_is_never_taken_for_one_that_was_closed) {
    const fs::path folder = fs::path(testing::TempDir()) / fmt::format("zonal_closed_{}", getpid());
    fs::remove_all(folder);
    const std::string emit = fmt::format("emit --order 2 --language glsl --out '{}'", folder.string());
    const auto text = [&] {
        std::ifstream stream(folder / "order02.glsl");
        return std::string(std::istreambuf_iterator<char>(stream), {});
    };
    ASSERT_EQ(zonal_gen(emit + " >/dev/null").status, 0);
    const std::string whole = text();
    fs::remove_all(folder);
    EXPECT_EQ(zonal_gen(emit + " >&-").status, 1);
    EXPECT_EQ(text(), whole);
}

/// Every option of a number, by command.
TEST(Arguments, every_number_is_read_in_one_way) {
    const std::string out = " --out " + (fs::path(testing::TempDir()) / "never.json").string();
    const std::string search = "search" + out + " --order 3";
    struct Case {
        std::string command, option;
        bool is_whole;
    };
    std::vector<Case> cases{{"emit --language cpp", "--order", true},
                            {"stats", "--order", true},
                            {"paper", "--sets", true},
                            {"paper", "--seed", true},
                            {"search" + out, "--order", true},
                            {"search" + out, "--band", true},
                            {search + " --band 4", "--mirrors", true}};
    for (const char* option : {"--seed", "--generations", "--zero-bands", "--rings", "--islands",
                               "--population", "--stall", "--elite", "--local-moves"})
        cases.push_back({search, option, true});
    for (const char* option : {"--seconds", "--crossover", "--mutation", "--multiplication-weight",
                               "--condition-weight", "--condition-cap"})
        cases.push_back({search, option, false});
    for (const auto& [command, option, is_whole] : cases)
        for (const char* text : {"nan", "inf", "1e999", "-1", "3x", "''", "0x3", "99999999999999999999"}) {
            const Outcome result = zonal_gen(fmt::format("{} {} {} >/dev/null", command, option, text));
            EXPECT_EQ(result.status, 1) << option << text;
            EXPECT_THAT(result.error,
                        AllOf(StartsWith("error: " + option + ": found '"),
                              HasSubstr(is_whole ? "wanted a whole number" : "wanted a number")))
                << option << ' ' << text;
            EXPECT_LT(result.error.size(), 200U) << result.error;
        }
    EXPECT_THAT(zonal_gen(search + " --mutation 0").error, HasSubstr("wanted a number above 0, at most 1"));
    EXPECT_THAT(zonal_gen("stats --order 010 --json >/dev/null").error, "");
    EXPECT_THAT(zonal_gen("stats --order 08 --json | grep -q '\"order\": 8,' || echo another >&2").error, "");
}

TEST(Messages, show_no_argument_to_the_terminal_as_it_is) {
    for (const char* arguments :
         {"emit --order 4 --language 'co\nbol\x1b[31m'", "stats --order '4\x1b[31m\n'",
          "stats --order 4 --table 'no\x1b[31m\nwhere'", "search --order 3 --out '/proc/no\x1b[31m\n/\x01'",
          "stats --order 4 '\x1b[31m\n'"}) {
        const Outcome result = zonal_gen(arguments);
        EXPECT_EQ(result.status, 1) << arguments;
        EXPECT_THAT(result.error, AllOf(StartsWith("error: "), Not(HasSubstr("\x1b")), HasSubstr("\\x1b")))
            << arguments;
        EXPECT_EQ(result.error.find('\n'), result.error.size() - 1) << arguments;
    }
}

}  // namespace
}  // namespace zonal::program
