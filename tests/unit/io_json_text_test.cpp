#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "io/input_file.hpp"
#include "io/json_text.hpp"

namespace zonal {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

template <class T>
std::string complaint_about(const char* text) {
    try {
        as<T>(parse_json(text));
    } catch (const WrongJson& error) {
        return error.what();
    }
    return "none";
}

TEST(JsonText, whole_numbers_are_whole_and_fit) {
    EXPECT_EQ(as<int>(parse_json("3")), 3);
    for (const char* text :
         {"3.9", "3.0", "4294967299", "-4294967299", "1e300", "true", "\"3\"", "null", "[3]"})
        EXPECT_EQ(complaint_about<int>(text), parse_json(text).dump()) << text;
    EXPECT_EQ(complaint_about<std::uint64_t>("-1"), "-1");
    EXPECT_EQ(as<std::uint64_t>(parse_json("18446744073709551615")), ~std::uint64_t{0});
    EXPECT_EQ(complaint_about<std::vector<int>>("[1, 2.5]"), "2.5");
}

TEST(JsonText, nothing_stands_for_a_value_of_another_kind) {
    EXPECT_EQ(complaint_about<double>("true"), "true");
    EXPECT_EQ(as<double>(parse_json("3")), 3.0);
    EXPECT_EQ((complaint_about<std::array<std::string, 2>>(R"(["a", "b", "c"])")), R"(["a","b","c"])");
    EXPECT_EQ((complaint_about<std::array<std::string, 2>>(R"(["a"])")), R"(["a"])");
    EXPECT_EQ(complaint_about<std::vector<int>>("{}"), "{}");
    EXPECT_EQ(complaint_about<std::string>("7"), "7");
}

TEST(JsonText, brackets_without_end_are_refused) {
    for (const char* bracket : {"[", "{\"a\":"}) {
        std::string text;
        for (int k = 0; k < 100000; ++k) text += bracket;
        EXPECT_THAT(complaint_about<int>(text.c_str()), HasSubstr("brackets within each other"));
    }
    const std::string closed = std::string(100000, '[') + std::string(100000, ']');
    EXPECT_THAT(complaint_about<int>(closed.c_str()), HasSubstr("brackets within each other"));
}

TEST(JsonText, breaks_are_placed_and_numbers_beyond_double_are_none) {
    EXPECT_EQ(complaint_about<int>("{\"a\": "), "a break at byte 7 of 6");
    EXPECT_EQ(complaint_about<double>("1e999"), "a number too large to be one");
}

TEST(JsonText, long_values_are_cut_in_messages) {
    const std::string text = '"' + std::string(1000, 'a') + '"';
    EXPECT_LT(complaint_about<int>(text.c_str()).size(), 100U);
}

std::string reason(const fs::path& path) {
    try {
        return "read: " + read_file(path);
    } catch (const Unreadable& error) {
        return error.what();
    }
}

TEST(InputFile, says_why_a_file_cannot_be_read) {
    EXPECT_EQ(reason("/nowhere/file"), "No such file or directory");
    EXPECT_EQ(reason(fs::temp_directory_path()), "it is a folder");
    EXPECT_EQ(reason("/dev/zero"), "it is not a regular file");
    const fs::path file = fs::path(testing::TempDir()) / ("zonal_input_" + std::to_string(getpid()));
    std::ofstream(file, std::ios::binary) << std::string("a\0b", 3);
    EXPECT_EQ(reason(file), std::string("read: a\0b", 9));
    fs::resize_file(file, std::uintmax_t{65} << 20U);
    EXPECT_EQ(reason(file), "it is larger than 64 MiB");
    fs::remove(file);
}

}  // namespace
}  // namespace zonal
