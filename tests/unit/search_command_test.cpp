#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "lobes/lobe_table.hpp"

namespace zonal {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
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
    ASSERT_EQ(search(quick + " --for rotate_zhf", "b.json"), 0);
    EXPECT_THAT(read_lobe_table(path("b.json"), use).command,
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
