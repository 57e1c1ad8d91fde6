#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <numeric>

#include "exact/angles.hpp"
#include "lobes/lobe_table.hpp"
#include "paper/comparison.hpp"
#include "paper/published.hpp"
#include "paper/random_sparsity.hpp"
#include "paper/sheets.hpp"

namespace zonal::paper {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// A folder with the tables of the project that are named.
fs::path folder_with(const std::vector<std::string>& tables) {
    const fs::path folder = fs::path(testing::TempDir()) / ("zonal_paper_" + std::to_string(getpid()));
    fs::remove_all(folder);
    fs::create_directories(folder);
    fs::create_directories(folder / "shared");
    for (const std::string& table : tables)
        fs::copy_file(fs::path(ZONAL_TABLES_DIR) / "shared" / table, folder / "shared" / table);
    return folder;
}

TEST(Published, rows_of_table_II_add_up_as_the_paper_defines_them) {
    int order = 3, product = 0;
    for (const published::Multiplications& row : published::kMultiplications) {
        product += (2 * order - 1) * (2 * order - 1);
        EXPECT_EQ(row.order, order);
        EXPECT_EQ(row.zxzxz, 3 * row.z_rotation + 2 * row.x_rotation) << order;
        EXPECT_EQ(row.y_product, product) << order;
        EXPECT_EQ(row.standard_cpu, (2 * order - 2) * row.basis + row.y_product + row.sparse) << order;
        EXPECT_EQ(row.standard_gpu, row.y_product + row.sparse) << order;
        ++order;
    }
    EXPECT_EQ(order, 20);
}

TEST(Published, lobes_and_zeros_of_table_I_agree) {
    int l = 2;
    for (const std::vector<int>& lobes : published::kLobesOfFunctions) {
        const int entries = (2 * l + 1) * (2 * l + 1);
        ASSERT_EQ(lobes.size(), 2 * l + 1);
        const int nonzeros = std::accumulate(lobes.begin(), lobes.end(), 0);
        EXPECT_NEAR(100.0 * (entries - nonzeros) / entries, published::kZerosOfBands[l - 2], 0.5) << l;
        ++l;
    }
}

TEST(Distribution, has_mean_quartiles_and_ends) {
    const Distribution d = distribution_of({7, 1, 3, 9, 5, 2});
    EXPECT_EQ(d.sets, 6);
    EXPECT_DOUBLE_EQ(d.mean, 4.5);
    EXPECT_DOUBLE_EQ(d.least, 1);
    EXPECT_DOUBLE_EQ(d.lower_quartile, 2.25);
    EXPECT_DOUBLE_EQ(d.median, 4);
    EXPECT_DOUBLE_EQ(d.upper_quartile, 6.5);
    EXPECT_DOUBLE_EQ(d.largest, 9);
    EXPECT_EQ(distribution_of({}).sets, 0);
}

TEST(Sparsity, entries_are_those_of_bands_from_2_on) {
    EXPECT_EQ(entries_of_order(3), 25);
    EXPECT_EQ(entries_of_order(4), 25 + 49);
}

TEST(Sparsity, two_lobes_of_one_direction_are_singular) {
    const search::CandidateGrid grid(2);
    EXPECT_FALSE(sparsity_of(grid, 3, search::LobeSet(5, grid.canonical(grid.pole(), 0))).has_value());
}

TEST(Sparsity, random_sets_repeat_and_no_band_2_has_more_than_16_zeros) {
    const RandomSparsity first = random_sparsity(3, 200, 1), again = random_sparsity(3, 200, 1);
    EXPECT_EQ(first.distribution.sets, 200);
    EXPECT_GT(first.drawn, 200);  // some are singular
    EXPECT_EQ(first.drawn, again.drawn);
    EXPECT_EQ(first.distribution.mean, again.distribution.mean);
    EXPECT_LE(first.distribution.largest, 64);
    EXPECT_GT(first.distribution.mean, 0);
    EXPECT_NE(first.distribution.mean, random_sparsity(3, 200, 2).distribution.mean);
}

TEST(Comparison, a_missing_table_is_null_and_what_needs_none_is_there) {
    const fs::path folder = folder_with({});
    EXPECT_TRUE(lobes_of_functions(folder)[0]["ours"].is_null());
    EXPECT_TRUE(zeros_of_bands(folder)[16]["percent"].is_null());
    const Json row = multiplications(folder, 4);
    EXPECT_TRUE(row["ours"]["sparse"].is_null());
    EXPECT_TRUE(row["ratio"]["sparse"].is_null());
    EXPECT_GT(row["ours"]["rotate"], 100);
    EXPECT_TRUE(sparsity(folder, 4, 10, 1)["searched_percent"].is_null());
}

TEST(Comparison, counts_of_a_table_are_those_of_its_nonzeros) {
    const fs::path folder = folder_with({"order03.json"});
    const Json row = multiplications(folder, 3);
    EXPECT_EQ(row["ours"]["sparse"], 9);
    EXPECT_EQ(row["ratio"]["sparse"], 1.0);
    EXPECT_EQ(sparsity(folder, 3, 10, 1)["searched_percent"], 64.0);
    EXPECT_TRUE(sparsity(folder, 3, 10, 1)["ratio"].is_null());
}

TEST(Comparison, the_searched_sparsity_is_set_against_the_papers_where_it_has_one) {
    const Json row = sparsity(folder_with({"order08.json"}), 8, 10, 1);
    EXPECT_EQ(row["paper"]["searched"], 45);
    EXPECT_DOUBLE_EQ(row["ratio"], row["searched_percent"].get<double>() / 45);
}

TEST(Comparison, lists_the_lobes_of_each_function_of_a_band) {
    const fs::path folder = folder_with({});
    LobeTable table;
    table.use = LobeUse::band(2);
    for (const auto& [theta, phi] : std::vector<std::pair<const char*, const char*>>{
             {"0", "0"}, {"pi/4", "0"}, {"pi/4", "pi/2"}, {"pi/2", "0"}, {"pi/2", "pi/4"}})
        table.lobes.push_back(Lobe::at(theta, phi));
    factorize(table);
    write_lobe_table(folder / table.use.table_path(), table);
    const Json row = lobes_of_functions(folder)[0];
    EXPECT_EQ(row["ours"][2], 1);  // y_2^0 is the lobe at the pole
    const auto lobes = row["ours"].get<std::vector<int>>();
    EXPECT_EQ(std::accumulate(lobes.begin(), lobes.end(), 0), table.nonzeros);
    EXPECT_DOUBLE_EQ(row["ratio"], table.nonzeros / 9.0);  // the paper's are 2 + 2 + 1 + 2 + 2
    EXPECT_EQ(zeros_of_bands(folder)[0]["zeros"], 25 - table.nonzeros);
    EXPECT_DOUBLE_EQ(zeros_of_bands(folder)[0]["ratio"], (25 - table.nonzeros) / 16.0);
}

TEST(Sheets, have_a_row_of_equal_length_for_every_number_and_say_what_is_missing) {
    const fs::path folder = folder_with({});
    const Json comparison{{"seed", 1},
                          {"lobes_of_functions", lobes_of_functions(folder)},
                          {"zeros_of_bands", zeros_of_bands(folder)},
                          {"multiplications", {multiplications(folder, 3)}},
                          {"sparsity", {sparsity(folder, 3, 20, 1)}},
                          {"expansion", {expansion(2, 1)}}};
    const std::vector<Sheet> sheets = sheets_of(comparison);
    for (const Sheet& sheet : sheets)
        for (const auto& row : sheet.rows) EXPECT_EQ(row.size(), sheet.rows.front().size()) << sheet.title;
    EXPECT_THAT(text_of(sheets), HasSubstr("no table"));
    const std::string page = page_of(comparison);
    for (const Sheet& sheet : sheets) EXPECT_THAT(page, HasSubstr(sheet.rows.back().back()));
    EXPECT_THAT(page, HasSubstr(figure_of(comparison).dump()));
}

TEST(PaperCommand, a_page_that_cannot_be_written_ends_it_at_once) {
    const std::string page = (folder_with({"order03.json"}) / "shared/order03.json" / "page.html").string();
    EXPECT_NE(std::system(("'" ZONAL_GEN "' paper --html '" + page + "' >/dev/null 2>&1").c_str()), 0);
}

}  // namespace
}  // namespace zonal::paper
