#include "io/output_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <iterator>
#include <thread>
#include <vector>

#include "io/user_error.hpp"

namespace zonal {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class OutputFile : public testing::Test {
  protected:
    OutputFile() {
        std::string name = (fs::temp_directory_path() / "zonal-output-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
        folder_ = name;
    }
    ~OutputFile() override { fs::remove_all(folder_); }

    fs::path path(const std::string& name) const { return folder_ / name; }
    void save(const std::string& name, const std::string& text) const { std::ofstream(path(name)) << text; }
    std::string text(const std::string& name) const {
        std::ifstream stream(path(name));
        return {std::istreambuf_iterator<char>(stream), {}};
    }
    std::ptrdiff_t files() const {
        return std::distance(fs::directory_iterator(folder_), fs::directory_iterator());
    }
    static std::string complaint(const fs::path& target) {
        try {
            write_file_atomically(target, "new");
        } catch (const UserError& error) {
            return error.what();
        }
        return "none";
    }
    static std::string early_complaint(const fs::path& target) {
        try {
            check_is_writable("--out", target);
        } catch (const UserError& error) {
            return error.what();
        }
        return "none";
    }

    fs::path folder_;
};

TEST_F(OutputFile, files_with_likely_temporary_names_stay) {
    for (const char* name : {"t.json.tmp", "t.json.probe", "t.json.probe.tmp"}) save(name, "the user's");
    check_is_writable("--out", path("t.json"));
    write_file_atomically(path("t.json"), "new");
    for (const char* name : {"t.json.tmp", "t.json.probe", "t.json.probe.tmp"})
        EXPECT_EQ(text(name), "the user's") << name;
    EXPECT_EQ(files(), 4);
}

TEST_F(OutputFile, writers_at_once_do_not_disturb_each_other) {
    std::vector<std::thread> writers;
    std::vector<std::string> complaints(4);
    for (std::string& found : complaints)
        writers.emplace_back([&found, target = path("t.json")] {
            for (int i = 0; i < 200; ++i)
                if (const std::string now = complaint(target); now != "none") found = now;
        });
    for (std::thread& writer : writers) writer.join();
    EXPECT_THAT(complaints, testing::Each(""));
    EXPECT_EQ(text("t.json"), "new");
    EXPECT_EQ(files(), 1);
}

TEST_F(OutputFile, link_stays_and_its_target_is_written) {
    save("target.json", "old");
    fs::create_symlink("target.json", path("link.json"));
    fs::create_symlink("later.json", path("dangling.json"));
    write_file_atomically(path("link.json"), "new");
    write_file_atomically(path("dangling.json"), "new");
    EXPECT_TRUE(fs::is_symlink(path("link.json")));
    EXPECT_EQ(text("target.json"), "new");
    EXPECT_TRUE(fs::is_symlink(path("dangling.json")));
    EXPECT_EQ(text("later.json"), "new");
}

TEST_F(OutputFile, existing_file_keeps_its_mode) {
    save("t.json", "old");
    fs::permissions(path("t.json"), fs::perms::owner_read | fs::perms::owner_write);
    write_file_atomically(path("t.json"), "new");
    EXPECT_EQ(fs::status(path("t.json")).permissions(), fs::perms::owner_read | fs::perms::owner_write);
}

TEST_F(OutputFile, what_is_not_a_regular_file_is_refused_early_and_late) {
    ASSERT_EQ(mkfifo(path("pipe").c_str(), 0600), 0);
    EXPECT_THAT(early_complaint(path("pipe")), HasSubstr("not a regular file"));
    EXPECT_THAT(complaint(path("pipe")), HasSubstr("not a regular file"));
    EXPECT_TRUE(fs::is_fifo(path("pipe")));
    EXPECT_THAT(early_complaint(folder_), HasSubstr("Is a directory"));
    EXPECT_THAT(complaint(folder_), HasSubstr("Is a directory"));
    EXPECT_THAT(early_complaint(path("pipe") / "t.json"), HasSubstr("Not a directory"));
}

TEST_F(OutputFile, names_of_the_system_are_refused_early_and_late) {
    const fs::path of_file = fs::path("/proc/self/fd/1");  // whatever it is open for
    fs::create_symlink(of_file, path("stdout"));
    for (const fs::path& target : {fs::path("/dev/stdout"), of_file, path("stdout"), fs::path("/proc/x"),
                                   fs::path("/sys/x"), fs::path("/dev/full"), fs::path()}) {
        EXPECT_NE(early_complaint(target), "none") << target;
        EXPECT_NE(complaint(target), "none") << target;
    }
    EXPECT_THAT(early_complaint(""), HasSubstr("the name is empty"));
    EXPECT_THAT(early_complaint("/proc/x"), HasSubstr("a name of the system"));
}

TEST_F(OutputFile, check_leaves_nothing) {
    check_is_writable("--out", path("made/later/t.json"));
    EXPECT_EQ(files(), 0);
}

TEST_F(OutputFile, same_file_is_known_through_links_before_it_exists) {
    fs::create_symlink("later.json", path("link.json"));
    EXPECT_TRUE(is_same_file(path("link.json"), path("later.json")));
    EXPECT_TRUE(is_same_file(path("a/../later.json"), path("later.json")));
    EXPECT_FALSE(is_same_file(path("other.json"), path("later.json")));
}

TEST_F(OutputFile, lock_loses_no_update) {
    save("count", "");
    std::vector<std::thread> writers;
    for (int writer = 0; writer < 4; ++writer)
        writers.emplace_back([this] {
            for (int i = 0; i < 50; ++i) {
                const OutputLock lock(path("count"));
                write_file_atomically(path("count"), text("count") + '.');
            }
        });
    for (std::thread& writer : writers) writer.join();
    EXPECT_EQ(text("count").size(), 200U);
}

}  // namespace
}  // namespace zonal
