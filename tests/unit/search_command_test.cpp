#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "io/output_file.hpp"
#include "lobes/lobe_table.hpp"

namespace zonal {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

/// A fresh folder, and the tool run in it with a table a.json to read and b.json to write.
class SearchCommand : public testing::Test {
  protected:
    SearchCommand() {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }

    /// `before` is put in front of the command.
    int search(const std::string& options, const std::string& out, const std::string& before = "") {
        const std::string command = before + " '" ZONAL_GEN "' search " + options + " --out '" + path(out) +
                                    "' >'" + path("output") + "' 2>&1";
        return std::system(command.c_str());
    }

    std::string path(const std::string& name) const { return (folder_ / name).string(); }

    std::string bytes(const std::string& name) const {
        std::ifstream stream(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(stream), {}};
    }

  private:
    fs::path folder_ = fs::path(testing::TempDir()) / ("zonal_search_" + std::to_string(getpid()));
};

TEST_F(SearchCommand, what_a_walk_makes_better_names_the_search_that_made_its_start) {
    ASSERT_EQ(search("--band 4 --generations 1 --on-grid --local-moves 20", "a.json"), 0);
    const LobeTable start = read_lobe_table(path("a.json"), LobeUse::band(4));
    ASSERT_EQ(search("--band 4 --walk --resume '" + path("a.json") +
                         "' --seed 3 --generations 2 --islands 2 --local-moves 300",
                     "b.json"),
              0);
    const LobeTable better = read_lobe_table(path("b.json"), LobeUse::band(4));
    EXPECT_LT(better.nonzeros, start.nonzeros);
    EXPECT_THAT(better.command, StartsWith(start.command + " && zonal-gen search --band 4 --seed 3 "));
    EXPECT_THAT(better.command, HasSubstr(" --walk --resume generator/tables/band/band04.json"));
}

TEST_F(SearchCommand, what_it_cannot_make_better_stays_as_it_was) {
    const fs::path table = fs::path(ZONAL_SOURCE_DIR) / "generator/tables/band/band02.json";
    ASSERT_EQ(search("--band 2 --walk --resume '" + table.string() +
                         "' --generations 1 --local-moves 100 --multiplication-weight 0 "
                         "--condition-weight 0",
                     "b.json"),
              0);
    std::ifstream stream(table, std::ios::binary);
    EXPECT_EQ(bytes("b.json"), (std::string{std::istreambuf_iterator<char>(stream), {}}));
}

TEST_F(SearchCommand, ctrl_c_ends_it_with_the_best_kept) {
    // It would go on for a year. `timeout` ends with the search's own status, 137 if it had to kill it.
    ASSERT_EQ(search("--band 4 --generations 1000000000 --stall 1000000000 --on-grid --local-moves 20",
                     "b.json", "timeout --preserve-status --signal INT --kill-after 60 10"),
              0);
    EXPECT_GT(read_lobe_table(path("b.json"), LobeUse::band(4)).nonzeros, 0);
    EXPECT_THAT(bytes("output"), HasSubstr(path("b.json")));
}

TEST_F(SearchCommand, writes_what_the_table_is_for) {
    const std::string quick = "--order 3 --generations 1 --on-grid --local-moves 20";
    ASSERT_EQ(search(quick, "a.json"), 0);
    EXPECT_EQ(read_lobe_table(path("a.json"), LobeUse::order(3)).use.role, TableRole::shared);
    const LobeUse use = LobeUse::order(3, TableRole::rotate_zhf);
    ASSERT_EQ(search(quick + " --for rotate_zhf --resume '" + path("a.json") + "'", "b.json"), 0);
    EXPECT_EQ(read_lobe_table(path("b.json"), use).use.role, TableRole::rotate_zhf);
    ASSERT_EQ(search(quick + " --for rotate_zhf", "c.json"), 0);
    EXPECT_THAT(read_lobe_table(path("c.json"), use).command,
                testing::AllOf(StartsWith("zonal-gen search --order 3 --for rotate_zhf --seed "),
                               HasSubstr(" --out generator/tables/rotate_zhf/order03.json")));
}

TEST_F(SearchCommand, refuses_to_find_an_order_what_only_a_band_has) {
    EXPECT_EQ(search("--order 3 --for band_mirrored", "b.json") >> 8, 1);
    EXPECT_THAT(bytes("output"), HasSubstr("--for: found 'band_mirrored', wanted shared or rotate_zhf"));
    EXPECT_EQ(search("--band 4 --for band_mirrored", "b.json") >> 8, 1);
    EXPECT_THAT(bytes("output"), HasSubstr("found no --mirrors"));
    EXPECT_FALSE(fs::exists(path("b.json")));
}

TEST_F(SearchCommand, a_walk_without_a_start_is_refused) {
    EXPECT_NE(search("--band 4 --walk", "b.json"), 0);
    EXPECT_THAT(bytes("output"), HasSubstr("--walk requires --resume"));
    EXPECT_FALSE(fs::exists(path("b.json")));
}

TEST_F(SearchCommand, a_better_table_that_is_there_stays) {
    const fs::path best = fs::path(ZONAL_SOURCE_DIR) / "generator/tables/band/band04.json";
    fs::copy_file(best, path("b.json"));
    const std::string before = bytes("b.json");
    ASSERT_EQ(search("--band 4 --generations 1 --on-grid --local-moves 20", "b.json"), 0);
    EXPECT_EQ(bytes("b.json"), before);
    EXPECT_THAT(bytes("output"), HasSubstr("b.json: kept as it was"));
}

TEST_F(SearchCommand, a_worse_table_that_is_there_gives_way) {
    ASSERT_EQ(search("--band 4 --generations 1 --on-grid --local-moves 20", "b.json"), 0);
    const int before = read_lobe_table(path("b.json"), LobeUse::band(4)).nonzeros;
    ASSERT_EQ(search("--band 4 --seed 3 --generations 2 --local-moves 3000", "b.json"), 0);
    EXPECT_LT(read_lobe_table(path("b.json"), LobeUse::band(4)).nonzeros, before);
    EXPECT_THAT(bytes("output"), testing::Not(HasSubstr("kept")));
}

TEST_F(SearchCommand, what_cannot_be_compared_is_refused_before_the_search) {
    const fs::path tables = fs::path(ZONAL_SOURCE_DIR) / "generator/tables";
    // It would go on for years.
    const std::string forever = " --generations 1000000000 --stall 1000000000";
    const auto complaint_about = [&](const std::string& use, const fs::path& there) {
        fs::copy_file(there, path("b.json"), fs::copy_options::overwrite_existing);
        const std::string before = bytes("b.json");
        EXPECT_EQ(search(use + forever, "b.json", "timeout 60") >> 8, 1) << use << there;
        EXPECT_EQ(bytes("b.json"), before) << use << there;
        return bytes("output");
    };
    std::ofstream(path("notes")) << "what nobody else knows\n";
    EXPECT_THAT(complaint_about("--band 4", path("notes")), HasSubstr("found another file"));
    EXPECT_THAT(complaint_about("--band 4", tables / "band/band05.json"),
                HasSubstr("band: found 5, wanted 4"));
    EXPECT_THAT(complaint_about("--order 8", tables / "rotate_zhf/order08.json"),
                HasSubstr("for: found \"rotate_zhf\", wanted \"shared\""));
    EXPECT_THAT(complaint_about("--order 8 --condition-cap 2", tables / "shared/order08.json"),
                HasSubstr("wanted at most the 2 of --condition-cap"));
}

TEST_F(SearchCommand, what_cannot_be_written_is_refused_before_the_search) {
    for (const char* out : {"''", "/dev/stdout", "/proc/x", "/proc/self/fd/1", "/dev/null", "/"}) {
        const std::string command = "timeout 60 '" ZONAL_GEN
                                    "' search --band 4 --generations 1000000000 --stall "
                                    "1000000000 --out " +
                                    std::string(out) + " >'" + path("output") + "' 2>&1";
        EXPECT_EQ(std::system(command.c_str()) >> 8, 1) << out;
        EXPECT_THAT(bytes("output"), testing::AllOf(StartsWith("error: --out"))) << out;
    }
}

TEST_F(SearchCommand, a_table_for_something_else_than_its_start_names_the_command_that_makes_it) {
    const fs::path start = fs::path(ZONAL_SOURCE_DIR) / "generator/tables/shared/order03.json";
    // No search finds better lobes: those of the start stay, but not what they are for.
    ASSERT_EQ(search("--order 3 --for rotate_zhf --generations 1 --on-grid --local-moves 20 --resume '" +
                         start.string() + "'",
                     "b.json"),
              0);
    EXPECT_THAT(read_lobe_table(path("b.json"), LobeUse::order(3, TableRole::rotate_zhf)).command,
                testing::AllOf(HasSubstr(" && zonal-gen search --order 3 --for rotate_zhf "),
                               HasSubstr(" --resume generator/tables/shared/order03.json "),
                               testing::EndsWith(" --out generator/tables/rotate_zhf/order03.json")));
}

TEST_F(SearchCommand, finding_nothing_gives_the_advice_that_fits_what_ended_it) {
    const std::string nothing = "--band 4 --on-grid --local-moves 20 --condition-cap 1 ";
    const auto advice = [&](const std::string& options, const std::string& before = "") {
        EXPECT_EQ(search(nothing + options, "b.json", before) >> 8, 1) << options;
        return bytes("output").substr(bytes("output").find("error: "));
    };
    EXPECT_THAT(advice("--generations 2"), HasSubstr("raise --generations,"));
    EXPECT_THAT(advice("--seconds 1"),
                testing::AllOf(HasSubstr("raise --seconds,"), Not(HasSubstr("--generations"))));
    EXPECT_THAT(advice("--stall 2"), HasSubstr("raise --stall,"));
    EXPECT_THAT(
        advice("--generations 1000000000", "timeout --preserve-status --signal INT --kill-after 60 2"),
        testing::AllOf(HasSubstr("told to stop: let it run longer"), Not(HasSubstr("raise --generations"))));
}

TEST_F(SearchCommand, lobes_closed_under_mirrors_are_not_for_a_table_of_others) {
    EXPECT_EQ(search("--band 4 --mirrors 2 --for band", "b.json") >> 8, 1);
    EXPECT_THAT(bytes("output"), HasSubstr("--for band: found --mirrors"));
    EXPECT_FALSE(fs::exists(path("b.json")));
}

TEST_F(SearchCommand, a_save_that_fails_is_tried_again_with_the_best_kept) {
    int errors[2];
    ASSERT_EQ(pipe(errors), 0);
    const std::string out = path("b.json");
    const pid_t child = fork();
    if (child == 0) {  // its disk is full: no file may have a byte
        std::signal(SIGXFSZ, SIG_IGN);
        const rlimit nothing{0, RLIM_INFINITY};
        setrlimit(RLIMIT_FSIZE, &nothing);
        dup2(errors[1], STDERR_FILENO);
        close(STDOUT_FILENO);
        open("/dev/null", O_WRONLY);
        execl(ZONAL_GEN, "zonal-gen", "search", "--band", "4", "--generations", "1000000000", "--stall",
              "1000000000", "--on-grid", "--local-moves", "20", "--out", out.c_str(), nullptr);
        _exit(127);
    }
    close(errors[1]);
    std::string said;
    for (char byte = 0; said.find("File too large") == std::string::npos && read(errors[0], &byte, 1) == 1;)
        said += byte;
    EXPECT_THAT(said, HasSubstr("warning: "));
    EXPECT_FALSE(fs::exists(out));
    const rlimit all{RLIM_INFINITY, RLIM_INFINITY};
    EXPECT_EQ(prlimit(child, RLIMIT_FSIZE, &all, nullptr), 0);
    kill(child, SIGINT);
    int status = 0;
    ASSERT_EQ(waitpid(child, &status, 0), child);
    close(errors[0]);
    EXPECT_EQ(status, 0);
    EXPECT_GT(read_lobe_table(out, LobeUse::band(4)).nonzeros, 0);
}

/// Nonzeros, multiplications and condition of every set of an archive.
std::vector<std::array<double, 3>> sets_of(const std::string& archive) {
    std::vector<std::array<double, 3>> sets;
    const auto json = nlohmann::json::parse(archive);
    for (const auto& set : json.at("sets"))
        sets.push_back({set.at("nonzeros"), set.at("multiplications"), set.at("cond")});
    return sets;
}

TEST_F(SearchCommand, adds_to_an_archive_and_loses_nothing_of_it) {
    const std::string archive = " --archive '" + path("front.json") + "'";
    ASSERT_EQ(search("--band 5 --generations 2 --on-grid --local-moves 300 --condition-weight 5" + archive,
                     "a.json"),
              0);
    const auto before = sets_of(bytes("front.json"));
    ASSERT_EQ(search("--band 5 --seed 2 --generations 2 --local-moves 3000" + archive, "b.json"), 0);
    const auto after = sets_of(bytes("front.json"));
    EXPECT_NE(after, before);
    for (const auto& set : before)
        EXPECT_TRUE(std::ranges::any_of(after, [&](const auto& other) {
            return other[0] <= set[0] && other[1] <= set[1] && other[2] <= set[2] * (1 + 1e-9);
        }));
    for (const auto& set : after)
        EXPECT_EQ(std::ranges::count_if(after,
                                        [&](const auto& other) {
                                            return other[0] <= set[0] && other[1] <= set[1] &&
                                                   other[2] <= set[2];
                                        }),
                  1)
            << "beaten by another set of the same archive";
    EXPECT_THAT(bytes("front.json"), HasSubstr("--seed 2 --generations 2"));
}

TEST_F(SearchCommand, two_searches_that_end_at_once_lose_nothing_of_one_archive) {
    const std::string options = "--band 4 --on-grid --local-moves 20 --generations ";
    fs::create_directories(path("shared"));
    const auto archive = [&](const std::string& name) {
        return " --archive '" + path("shared/" + name) + "'";
    };
    ASSERT_EQ(search(options + "2 --seed 5" + archive("other.json"), "a.json"), 0);
    int status = -1;
    std::thread one;
    {
        const OutputLock other(path("shared/front.json"));  // a search that is about to write
        one = std::thread([&] { status = search(options + "1 --seed 9" + archive("front.json"), "b.json"); });
        while (!fs::exists(path("output")) || bytes("output").find("generation 1") == std::string::npos)
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        std::this_thread::sleep_for(std::chrono::seconds(1));
        EXPECT_FALSE(fs::exists(path("shared/front.json"))) << "it did not wait";
        fs::copy_file(path("shared/other.json"), path("shared/front.json"),
                      fs::copy_options::overwrite_existing);
    }
    one.join();
    EXPECT_EQ(status, 0);
    const auto after = sets_of(bytes("shared/front.json"));
    for (const auto& set : sets_of(bytes("shared/other.json")))
        EXPECT_TRUE(std::ranges::any_of(after, [&](const auto& other) {
            return other[0] <= set[0] && other[1] <= set[1] && other[2] <= set[2] * (1 + 1e-9);
        }));
}

TEST_F(SearchCommand, believes_no_archive_that_its_angles_do_not_confirm) {
    const std::string options = "--band 3 --generations 1 --on-grid --archive '" + path("front.json") + "'";
    ASSERT_EQ(search(options, "a.json"), 0);
    const auto complaint_about = [&](const auto& change) {
        auto json = nlohmann::json::parse(bytes("front.json"));
        const std::string whole = bytes("front.json");
        change(json);
        std::ofstream(path("front.json")) << json.dump();
        const std::string changed = bytes("front.json");
        EXPECT_NE(search(options, "b.json"), 0);
        EXPECT_EQ(bytes("front.json"), changed) << "it is lost";
        EXPECT_FALSE(fs::exists(path("b.json")));
        std::ofstream(path("front.json")) << whole;
        return bytes("output");
    };
    EXPECT_THAT(complaint_about([](auto& json) { json["band"] = 4; }),
                HasSubstr("front.json: band: found 4, wanted 3"));
    EXPECT_THAT(complaint_about([](auto& json) { json["sets"][0]["nonzeros"] = 7; }),
                HasSubstr("sets[0].nonzeros: found 7, wanted 1"));
    EXPECT_THAT(complaint_about([](auto& json) { json["sets"][0]["angles"][0][0] = "pi/"; }),
                HasSubstr("sets[0].angles: found "));
    EXPECT_THAT(complaint_about([](auto& json) { json["sets"][0].erase("command"); }),
                HasSubstr("sets[0].command: found nothing, wanted a text"));
    EXPECT_THAT(complaint_about([](auto& json) { json = "no archive"; }), HasSubstr("band: found nothing"));
}

TEST_F(SearchCommand, request_to_terminate_keeps_the_best) {
    EXPECT_EQ(search("--band 4 --seconds 60 --on-grid", "a.json", "timeout --preserve-status 3"), 0);
    EXPECT_NO_THROW(read_lobe_table(path("a.json"), LobeUse::band(4)));
}

TEST_F(SearchCommand, archive_that_is_the_table_is_refused) {
    fs::create_symlink("a.json", path("link.json"));
    EXPECT_NE(search("--band 4 --generations 1 --on-grid --archive '" + path("link.json") + "'", "a.json"),
              0);
    EXPECT_THAT(bytes("output"), HasSubstr("wanted another"));
    EXPECT_FALSE(fs::exists(path("a.json")));
}

}  // namespace
}  // namespace zonal
