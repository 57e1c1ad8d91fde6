// zonal rotate-map as people run it.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

class RotateMap : public testing::Test {
  protected:
    RotateMap() { fs::create_directories(folder_); }
    ~RotateMap() override { fs::remove_all(folder_); }

    /// Exit status; what it says is in `said`.
    int run(const std::string& arguments, const std::string& output = "") {
        const fs::path log = folder_ / "log";
        const std::string to = output.empty() ? fmt::format(">'{}'", log.string()) : output;
        const int status = std::system(
            fmt::format("'{}' rotate-map --order 2 --map '{}' --out '{}' {} {} 2>'{}.error'", ZONAL_PROGRAM,
                        map_, (folder_ / "out").string(), arguments, to, log.string())
                .c_str());
        said = read(log.string() + ".error");
        printed = output.empty() ? read(log) : "";
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    static std::string read(const fs::path& path) {
        std::ifstream stream(path);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

    fs::path folder_ = fs::path(testing::TempDir()) / fmt::format("zonal_rotate_map_{}", getpid());
    std::string map_ = ZONAL_TEST_DATA "/studio.exr", said, printed;
};

TEST_F(RotateMap, an_axis_of_any_finite_length_is_one) {
    ASSERT_EQ(run("--axis 1 2 3"), 0) << said;
    const std::string of_unit = printed;
    for (const char* axis : {"1e-300 2e-300 3e-300", "0.5e308 1e308 1.5e308", "1e-320 2e-320 3e-320"}) {
        EXPECT_EQ(run(fmt::format("--axis {}", axis)), 0) << axis << said;
        if (std::string(axis) != "1e-320 2e-320 3e-320") {  // denormals have few digits
            EXPECT_EQ(printed, of_unit) << axis;
        }
    }
    EXPECT_EQ(run("--axis 0 -0 0"), 1);
    EXPECT_THAT(said, StartsWith("error: --axis: found 0 0 0, wanted a vector that is not zero"));
}

TEST_F(RotateMap, numbers_are_read_as_by_every_program) {
    for (const char* arguments : {"--axis 1 nan 0", "--axis 1 inf 0", "--angle-degrees nan",
                                  "--angle-degrees 1e999", "--angle-degrees 7x"}) {
        EXPECT_EQ(run(arguments), 1) << arguments;
        EXPECT_THAT(said, AllOf(StartsWith("error: --a"), HasSubstr("wanted a number"))) << arguments;
    }
}

TEST_F(RotateMap, output_that_did_not_arrive_is_an_error) {
    for (const char* nowhere : {">/dev/full", ">&-"}) {
        EXPECT_EQ(run("", nowhere), 1) << nowhere;
        EXPECT_THAT(said, StartsWith("error: standard output: cannot write: ")) << nowhere;
        EXPECT_TRUE(fs::exists(folder_ / "out/side_by_side.png"));
    }
}

TEST_F(RotateMap, shows_no_name_to_the_terminal_as_it_is) {
    map_ = "no\x1b[31m\nwhere";
    EXPECT_EQ(run(""), 1);
    EXPECT_THAT(said, AllOf(HasSubstr("no\\x1b[31m\\x0awhere"), testing::Not(HasSubstr("\x1b"))));
}

}  // namespace
