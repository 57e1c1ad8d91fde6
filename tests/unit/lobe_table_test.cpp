#include "lobes/lobe_table.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "io/user_error.hpp"
#include "kernels/lobes.hpp"

namespace zonal {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// An order-3 table with 16 zeros in band 2.
LobeTable small_table() {
    LobeTable table;
    table.use = LobeUse::order(3);
    table.seed = 7;
    table.command = "zonal-gen search --order 3 --seed 7 --out generator/tables/shared/order03.json";
    for (const auto& [theta, phi] :
         std::vector<std::pair<const char*, const char*>>{{"0", "0"},
                                                          {"acos(sqrt(1/3))", "pi/4"},
                                                          {"acos(sqrt(1/3))", "7*pi/4"},
                                                          {"acos(sqrt(1/3))", "5*pi/4"},
                                                          {"pi/2", "pi/2"}})
        table.lobes.push_back(Lobe::at(theta, phi));
    factorize(table);
    return table;
}

class LobeTableFile : public testing::Test {
  protected:
    LobeTableFile() {
        folder_ = fs::temp_directory_path() / ("zonal_lobe_table_test_" + std::to_string(getpid()));
        fs::create_directories(folder_);
        path_ = folder_ / "order03.json";
    }
    ~LobeTableFile() override { fs::remove_all(folder_); }

    std::string text_of(const LobeTable& table) {
        write_lobe_table(path_, table);
        std::ostringstream text;
        text << std::ifstream(path_).rdbuf();
        return text.str();
    }

    void save(const std::string& text) const { std::ofstream(path_) << text; }

    /// Changes the one place of the file where `from` stands first.
    void edit(const std::string& from, const std::string& to) {
        std::string text = text_of(small_table());
        const std::size_t place = text.find(from);
        ASSERT_NE(place, std::string::npos) << from;
        save(text.replace(place, from.size(), to));
    }

    std::string complaint(int order = 3, double cap = kConditionCap) const {
        try {
            read_lobe_table(path_, LobeUse::order(order), cap);
        } catch (const UserError& error) {
            return error.what();
        }
        return "no complaint";
    }

    /// File and next step, which every message has.
    auto names_file_and_next_step() const {
        return AllOf(HasSubstr(path_.string()), HasSubstr("zonal-gen search --order 3 --out NEW.json"),
                     Not(HasSubstr("--out " + path_.string())));
    }

    fs::path folder_, path_;
};

TEST_F(LobeTableFile, what_is_written_is_read_back) {
    const LobeTable written = small_table();
    write_lobe_table(path_, written);
    const LobeTable read = read_lobe_table(path_, LobeUse::order(3));
    EXPECT_EQ(read.use.value, 3);
    EXPECT_EQ(read.seed, 7);
    EXPECT_EQ(read.command, written.command);
    EXPECT_EQ(read.zeros, written.zeros);
    EXPECT_EQ(read.zeros, (std::vector<int>{0, 3, 16}));
    EXPECT_EQ(read.nonzeros, 9);
    EXPECT_EQ(read.sha256.size(), 64);
    for (int d = 0; d < 5; ++d) {
        EXPECT_LT((read.lobes[d].direction - written.lobes[d].direction).norm(), exact::Real{"1e-48"});
        EXPECT_EQ(read.lobes[d].theta, written.lobes[d].theta);
        EXPECT_EQ(read.lobes[d].phi, written.lobes[d].phi);
    }
}

TEST_F(LobeTableFile, same_table_gives_same_bytes) {
    const std::string first = text_of(small_table());
    const std::string sum = read_lobe_table(path_, LobeUse::order(3)).sha256;
    EXPECT_EQ(text_of(read_lobe_table(path_, LobeUse::order(3))), first);
    EXPECT_EQ(read_lobe_table(path_, LobeUse::order(3)).sha256, sum);
}

TEST_F(LobeTableFile, sha256_changes_with_any_byte) {
    const std::string text = text_of(small_table());
    save(text + "\n");
    const std::string longer = read_lobe_table(path_, LobeUse::order(3)).sha256;
    save(text);
    EXPECT_NE(read_lobe_table(path_, LobeUse::order(3)).sha256, longer);
}

TEST_F(LobeTableFile, missing_file_is_named) {
    EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(),
                                   HasSubstr("found nothing that can be read (No such file or directory)")));
}

TEST_F(LobeTableFile, truncated_file_says_where_it_breaks) {
    const std::string text = text_of(small_table());
    save(text.substr(0, text.size() / 2));
    EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(), HasSubstr("truncated"), HasSubstr("byte")));
}

TEST_F(LobeTableFile, missing_field_is_named) {
    edit("\"seed\"", "\"sead\"");
    EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(), HasSubstr("seed: found nothing")));
}

TEST_F(LobeTableFile, field_of_another_type_is_named_with_its_value) {
    edit("\"seed\": 7", "\"seed\": \"seven\"");
    EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(), HasSubstr("seed: found \"seven\"")));
}

TEST_F(LobeTableFile, a_folder_is_named_as_such) {
    fs::create_directories(path_);
    EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(), HasSubstr("it is a folder")));
}

TEST_F(LobeTableFile, numbers_that_are_not_whole_or_do_not_fit_are_named) {
    const auto refused = [&](const std::string& from, const std::string& to, const char* message) {
        edit(from, to);
        EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(), HasSubstr(message)));
    };
    refused("\"order\": 3", "\"order\": 3.9", "order: found 3.9, wanted an integer");
    refused("\"order\": 3", "\"order\": 4294967299", "order: found 4294967299, wanted an integer");
    refused("\"order\": 3", "\"order\": 1e300", "order: found 1e+300, wanted an integer");
    refused("\"order\": 3", "\"order\": true", "order: found true, wanted an integer");
    refused("\"seed\": 7", "\"seed\": -1", "seed: found -1, wanted a non-negative integer");
    refused("\"zeros\": [0", "\"zeros\": [0.5", "zeros: found 0.5");
}

TEST_F(LobeTableFile, what_has_no_end_is_refused_at_once) {
    edit("[\"pi/2\"", "[\"1e999999999\"");
    EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(), HasSubstr("angles[4]: found cannot read")));
    const std::string text = text_of(small_table());
    const std::size_t digits = text.find("[\"0") + 2;
    save(text.substr(0, digits) + "1e999999999" + text.substr(text.find('"', digits)));
    EXPECT_THAT(complaint(),
                AllOf(names_file_and_next_step(), HasSubstr("directions: found \"1e999999999\"")));
    save(std::string(100000, '['));
    EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(), HasSubstr("brackets within each other")));
}

TEST_F(LobeTableFile, next_step_says_what_made_such_a_table) {
    try {
        read_lobe_table(path_, LobeUse::order(9, TableRole::rotate_zhf));
        FAIL() << "read";
    } catch (const UserError& error) {
        EXPECT_THAT(error.what(), HasSubstr("--order 9 --for rotate_zhf --condition-cap 20 --out NEW.json"));
    }
}

TEST_F(LobeTableFile, another_order_is_refused) {
    write_lobe_table(path_, small_table());
    EXPECT_THAT(complaint(4), AllOf(HasSubstr("order: found 3, wanted 4"), HasSubstr("--order 4")));
}

TEST_F(LobeTableFile, wrong_number_of_directions_is_refused) {
    LobeTable table = small_table();
    table.lobes.pop_back();
    write_lobe_table(path_, table);
    EXPECT_THAT(complaint(),
                AllOf(names_file_and_next_step(), HasSubstr("directions: found 4 entries, wanted 5")));
}

TEST_F(LobeTableFile, duplicate_lobe_is_refused) {
    LobeTable table = small_table();
    table.lobes[4] = table.lobes[1];
    write_lobe_table(path_, table);
    EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(),
                                   HasSubstr("directions[4]: found the lobe of directions[1] again")));
}

TEST_F(LobeTableFile, antipodal_lobe_is_a_duplicate) {
    LobeTable table = small_table();
    table.lobes[3].direction = -table.lobes[0].direction;
    write_lobe_table(path_, table);
    EXPECT_THAT(complaint(),
                AllOf(names_file_and_next_step(), HasSubstr("directions[3]"), HasSubstr("antipode")));
}

TEST_F(LobeTableFile, direction_that_is_not_unit_is_refused) {
    LobeTable table = small_table();
    table.lobes[2].direction *= exact::Real{"1.000001"};
    write_lobe_table(path_, table);
    EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(), HasSubstr("directions[2]"),
                                   HasSubstr("found squared length 1 + 2e-06"), HasSubstr("unit direction")));
}

TEST_F(LobeTableFile, component_that_is_no_number_is_refused) {
    edit("[\"0\", \"0\", \"1\"]", "[\"0\", \"zero\", \"1\"]");
    EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(), HasSubstr("directions: found \"zero\"")));
}

TEST_F(LobeTableFile, angles_must_give_the_directions) {
    edit("[\"pi/2\", \"pi/2\"]", "[\"pi/2\", \"pi/3\"]");
    EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(), HasSubstr("angles[4]"), HasSubstr("pi/3")));
}

TEST_F(LobeTableFile, angle_that_cannot_be_read_is_quoted) {
    edit("[\"pi/2\", \"pi/2\"]", "[\"pi/2\", \"half a turn\"]");
    EXPECT_THAT(complaint(),
                AllOf(names_file_and_next_step(), HasSubstr("angles[4]"), HasSubstr("half a turn")));
}

/// Replaces one lobe and measures anew, so that nothing else is wrong with the table.
LobeTable with_lobe(LobeTable table, int d, const std::string& theta, const std::string& phi) {
    table.lobes[d] = Lobe::at(theta, phi);
    factorize(table);
    return table;
}

TEST_F(LobeTableFile, singular_band_is_named) {
    // Two lobes of one meridian with the pole: band 1 has no third dimension. Infinity is no JSON, so the
    // file claims some number.
    LobeTable table = with_lobe(small_table(), 2, "acos(1/7)", "pi/4");
    ASSERT_TRUE(std::isinf(table.condition[1]));
    table.condition = {1, 1, 1};
    write_lobe_table(path_, table);
    EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(), HasSubstr("cond[1]"),
                                   HasSubstr("singular lobes in band 1")));
}

TEST_F(LobeTableFile, condition_over_the_cap_is_refused) {
    write_lobe_table(path_, with_lobe(small_table(), 2, "acos(1/7)", "pi/4+1/1000"));
    EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(), HasSubstr("cond[1]: found condition"),
                                   HasSubstr("wanted at most 50")));
}

TEST_F(LobeTableFile, smaller_cap_may_be_asked_for) {
    write_lobe_table(path_, small_table());
    EXPECT_EQ(complaint(3, 10), "no complaint");
    EXPECT_THAT(complaint(3, 2), HasSubstr("wanted at most 2"));
}

TEST_F(LobeTableFile, claims_that_the_directions_do_not_confirm_are_refused) {
    const auto refused = [&](LobeTable table, const char* message) {
        write_lobe_table(path_, table);
        EXPECT_THAT(complaint(), AllOf(names_file_and_next_step(), HasSubstr(message)));
    };
    LobeTable table = small_table();
    table.zeros[2] = 17;
    refused(table, "zeros[2]: found 17, wanted 16");
    table = small_table();
    table.nonzeros = 8;
    refused(table, "nonzeros: found 8, wanted 9");
    table = small_table();
    table.condition[2] *= 1.01;
    refused(table, "cond[2]: found");
}

TEST_F(LobeTableFile, rounding_of_the_condition_is_forgiven) {
    LobeTable table = small_table();
    table.condition[2] *= 1 + 1e-6;
    write_lobe_table(path_, table);
    EXPECT_EQ(complaint(), "no complaint");
}

TEST_F(LobeTableFile, writing_into_a_file_as_if_a_folder_fails_and_leaves_nothing) {
    save("not a folder");
    const fs::path inside = path_ / "order03.json";
    try {
        write_lobe_table(inside, small_table());
        ADD_FAILURE() << "written";
    } catch (const UserError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr(inside.string()), HasSubstr("cannot write")));
    }
    EXPECT_EQ(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()), 1);
}

TEST_F(LobeTableFile, what_it_is_for_is_read_back) {
    LobeTable table = small_table();
    table.use = LobeUse::order(3, TableRole::rotate_zhf);
    write_lobe_table(path_, table);
    EXPECT_EQ(read_lobe_table(path_, table.use).use.role, TableRole::rotate_zhf);
    EXPECT_EQ(read_lobe_table_of_any_role(path_, LobeUse::order(3)).use.role, TableRole::rotate_zhf);
}

TEST_F(LobeTableFile, a_table_that_does_not_say_what_it_is_for_is_refused) {
    edit("  \"for\": \"shared\",\n", "");
    EXPECT_THAT(complaint(),
                AllOf(names_file_and_next_step(), HasSubstr("for: found nothing"), HasSubstr("rotate_zhf")));
}

TEST_F(LobeTableFile, a_table_that_is_for_something_else_is_refused) {
    edit("\"for\": \"shared\"", "\"for\": \"rotate_zhf\"");
    EXPECT_THAT(complaint(),
                AllOf(names_file_and_next_step(), HasSubstr("for: found \"rotate_zhf\", wanted \"shared\"")));
}

TEST_F(LobeTableFile, a_table_of_an_order_cannot_be_for_a_band) {
    for (const char* word : {"band", "band_mirrored", "bands"}) {
        edit("\"for\": \"shared\"", fmt::format("\"for\": \"{}\"", word));
        EXPECT_THAT(complaint(), AllOf(HasSubstr(fmt::format("for: found \"{}\"", word)),
                                       HasSubstr("wanted \"shared\" or \"rotate_zhf\"")));
    }
}

TEST_F(LobeTableFile, reading_inverts_every_band_once) {
    write_lobe_table(path_, small_table());
    const int before = factorized_bands();
    const LobeTable table = read_lobe_table(path_, LobeUse::order(3));
    EXPECT_EQ(factorized_bands() - before, 3);
    ASSERT_EQ(table.bands.size(), 3);
    EXPECT_EQ(table.bands[2].zeros, 16);
    kernels::LobeSet::shared(table);
    EXPECT_EQ(factorized_bands() - before, 3);
}

TEST(LobeUse, names_its_table_by_what_it_is_for_and_two_digits) {
    EXPECT_EQ(LobeUse::order(4).table_path(), "shared/order04.json");
    EXPECT_EQ(LobeUse::order(12).table_path(), "shared/order12.json");
    EXPECT_EQ(LobeUse::band(7).table_path(), "band/band07.json");
    EXPECT_EQ(LobeUse::band(7, TableRole::band_mirrored).table_path(), "band_mirrored/band07.json");
    EXPECT_EQ(LobeUse::order(9, TableRole::rotate_zhf).table_path(), "rotate_zhf/order09.json");
}

TEST(LobeUse, band_takes_twice_its_number_and_one_lobes) {
    EXPECT_EQ(LobeUse::band(7).lobe_count(), 15);
    EXPECT_EQ(LobeUse::order(7).lobe_count(), 13);
    EXPECT_EQ(LobeUse::order(3).bands, (std::vector<int>{0, 1, 2}));
}

TEST_F(LobeTableFile, table_of_one_band_is_read_back) {
    LobeTable band = small_table();
    band.use = LobeUse::band(2);
    factorize(band);
    write_lobe_table(path_, band);
    const LobeTable read = read_lobe_table(path_, LobeUse::band(2));
    EXPECT_EQ(read.zeros, std::vector<int>{16});
    EXPECT_EQ(read.nonzeros, 9);
}

TEST_F(LobeTableFile, table_of_an_order_is_none_of_a_band) {
    write_lobe_table(path_, small_table());
    try {
        read_lobe_table(path_, LobeUse::band(2));
        FAIL() << "not refused";
    } catch (const UserError& error) {
        EXPECT_THAT(error.what(), AllOf(HasSubstr("order: found 3, wanted a table of band 2"),
                                        HasSubstr("--band 2"), Not(HasSubstr("restore"))));
    }
}

LobeTable committed_table(const LobeUse& use) {
    const LobeTable table = read_lobe_table(fs::path(ZONAL_TABLES_DIR) / use.table_path(), use);
    EXPECT_THAT(table.command, HasSubstr("--out generator/tables/" + use.table_path().string()));
    return table;
}

class CommittedTableOfAnOrder : public testing::TestWithParam<int> {};

/// Nowrouzezahrai et al., Table II, from N = 11 on; below, what is asked of this project.
TEST_P(CommittedTableOfAnOrder, is_verified_and_not_worse_than_promised) {
    const int order = GetParam();
    const std::map<int, int> promised{{3, 9},     {4, 28},    {5, 67},    {6, 132},   {7, 222},
                                      {8, 336},   {9, 503},   {10, 712},  {11, 1117}, {12, 1452},
                                      {13, 1848}, {14, 2332}, {15, 2850}, {16, 3523}, {17, 4198},
                                      {18, 5029}, {19, 6013}, {20, 10648}};
    EXPECT_LE(committed_table(LobeUse::order(order)).nonzeros, promised.at(order));
}

INSTANTIATE_TEST_SUITE_P(orders, CommittedTableOfAnOrder, testing::Range(3, 21));

class TableOfRotateZhf : public testing::TestWithParam<int> {};

TEST_P(TableOfRotateZhf, is_verified_and_better_conditioned_than_the_sparsest_lobes) {
    const LobeTable own = committed_table(LobeUse::order(GetParam(), TableRole::rotate_zhf));
    const LobeTable sparsest = committed_table(LobeUse::order(GetParam()));
    EXPECT_LT(std::ranges::max(own.condition), std::ranges::max(sparsest.condition));
}

INSTANTIATE_TEST_SUITE_P(orders, TableOfRotateZhf, testing::Values(8, 9, 10, 11, 12, 13, 16));

class CommittedTableOfABand : public testing::TestWithParam<int> {};

/// Zeros; above l = 10 in per mille: of the paper's Table I where nothing more is asked.
TEST_P(CommittedTableOfABand, is_verified_and_not_worse_than_promised) {
    const int l = GetParam();
    const std::map<int, int> zeros{{2, 16},  {3, 33},  {4, 52},  {5, 74},  {6, 102},
                                   {7, 129}, {8, 167}, {9, 181}, {10, 240}};
    const std::map<int, int> per_mille{{11, 474}, {12, 528}, {13, 371}, {14, 518},
                                       {15, 361}, {16, 406}, {17, 351}, {18, 473}};
    const LobeTable table = committed_table(LobeUse::band(l));
    if (zeros.contains(l))
        EXPECT_GE(table.zeros[0], zeros.at(l));
    else
        EXPECT_GE(1000 * table.zeros[0], per_mille.at(l) * (2 * l + 1) * (2 * l + 1));
}

INSTANTIATE_TEST_SUITE_P(bands, CommittedTableOfABand, testing::Range(2, 19));

}  // namespace
}  // namespace zonal
