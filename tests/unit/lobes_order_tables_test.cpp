#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "bounds/body_hash.hpp"
#include "bounds/published.hpp"
#include "io/user_error.hpp"
#include "kernels/order_kernels.hpp"
#include "lobes/order_tables.hpp"

namespace zonal {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

const fs::path kTables = ZONAL_TABLES_DIR;

template <class Work>
std::string complaint_of(const Work& work) {
    try {
        work();
    } catch (const UserError& error) {
        return error.what();
    }
    return "none";
}

/// A copy of the project's tables that a test may spoil, and where the program looks.
class OwnTables : public testing::Test {
  protected:
    OwnTables() {
        home_ = fs::path(testing::TempDir()) / ("zonal_own_tables_" + std::to_string(getpid()));
        folder_ = home_ / "tables";
        bounds_ = home_ / "bounds/bounds.json";
        fs::remove_all(home_);
        fs::create_directories(home_);
        fs::copy(kTables, folder_, fs::copy_options::recursive);
        fs::create_directories(bounds_.parent_path());
        fs::copy(kTables.parent_path() / "bounds/bounds.json", bounds_);
        setenv("ZONAL_TABLES_DIR", folder_.c_str(), 1);
    }
    ~OwnTables() override {
        unsetenv("ZONAL_TABLES_DIR");
        fs::remove_all(home_);
    }

    static std::string complaint_about_order(int order) {
        return complaint_of([&] { published_bounds(build_order_kernels(order)); });
    }

    fs::path home_, folder_, bounds_;
};

TEST(PublishedTables, are_those_of_the_folder) {
    std::size_t published = 0;
    for (int k = 2; k <= 20; ++k)
        for (const LobeUse& use : {LobeUse::order(k), LobeUse::order(k, TableRole::rotate_zhf),
                                   LobeUse::band(k), LobeUse::band(k, TableRole::band_mirrored)}) {
            published += use.is_published();
            EXPECT_EQ(use.is_published(), fs::exists(kTables / use.table_path())) << use.table_path();
        }
    std::size_t files = 0;
    for (const auto& entry : fs::recursive_directory_iterator(kTables))
        files += entry.path().extension() == ".json";
    EXPECT_EQ(published, files);
    EXPECT_EQ(complaint_of([] { check_tables_are_there(kTables); }), "none");
}

TEST_F(OwnTables, a_missing_one_is_an_error_that_names_it) {
    for (const char* table : {"shared/order08.json", "rotate_zhf/order08.json", "band/band05.json",
                              "band_mirrored/band05.json"}) {
        fs::rename(folder_ / table, folder_ / "aside");
        for (const std::string& complaint :
             {complaint_about_order(8), complaint_of([&] { check_tables_are_there(folder_); })})
            EXPECT_THAT(complaint, AllOf(HasSubstr((folder_ / table).string() + ": found no such file"),
                                         HasSubstr("ZONAL_TABLES_DIR")));
        fs::rename(folder_ / "aside", folder_ / table);
    }
    EXPECT_EQ(complaint_about_order(3), "none");
}

TEST_F(OwnTables, a_missing_folder_is_named_as_such) {
    setenv("ZONAL_TABLES_DIR", "/nowhere", 1);
    EXPECT_THAT(complaint_about_order(3), HasSubstr("/nowhere: found no such folder"));
    EXPECT_THAT(complaint_about_order(2), HasSubstr("/bounds/bounds.json: file: found nothing"));
}

TEST_F(OwnTables, bounds_that_are_missing_or_of_something_else_are_an_error) {
    const fs::path path = bounds_;
    const auto complaint_with = [&](const std::string& text) {
        std::ofstream(path) << text;
        return complaint_about_order(3);
    };
    std::ifstream stream(path);
    const std::string whole{std::istreambuf_iterator<char>(stream), {}};
    const auto edited = [&](const std::string& from, const std::string& to) {
        std::string text = whole;
        return text.replace(text.find(from), from.size(), to);
    };
    EXPECT_THAT(complaint_with(""), HasSubstr("bounds.json: JSON text: found a break"));
    EXPECT_THAT(complaint_with("[]"), HasSubstr("bounds: found nothing, wanted a list"));
    EXPECT_THAT(complaint_with("{\"bounds\": []}"),
                AllOf(HasSubstr("bounds: found none of rotate_tensor of order 3"), HasSubstr("--orders 3")));
    EXPECT_THAT(complaint_with(edited("\"order\": 2,", "\"order\": 2.5,")),
                HasSubstr("bounds[0].order: found 2.5, wanted a whole number"));
    EXPECT_THAT(complaint_with(edited("\"float\": \"2.2e-07\"", "\"float\": \"1\\nint x;\"")),
                HasSubstr("bounds[0].float: found \"1\\nint x;\", wanted a positive decimal"));
    const OrderKernels kernels = build_order_kernels(3);
    const std::string body = body_hash(graph::kernel_named(kernels.kernels, "rotate_zhf"), kernels.kernels);
    EXPECT_THAT(complaint_with(edited(body, "0123456789abcdef")),  // measured with other tables
                AllOf(HasSubstr("found none of rotate_zhf of order 3 with the body " + body),
                      HasSubstr("--missing --orders 3")));
    fs::remove(path);
    EXPECT_THAT(complaint_about_order(3), HasSubstr("bounds.json: file: found nothing that can be read"));
}

TEST_F(OwnTables, a_chosen_table_serves_what_it_is_for) {
    TableShelf shelf = project_tables();
    const OrderTables standard = shelf.of_order(8);
    const OrderTables shared = shelf.of_order(8, folder_ / "shared/order08.json");
    EXPECT_EQ(shared.shared, shared.chosen);
    EXPECT_EQ(shared.rotate_zhf->table.sha256, standard.rotate_zhf->table.sha256);
    const OrderTables turned = shelf.of_order(8, folder_ / "rotate_zhf/order08.json");
    EXPECT_EQ(turned.rotate_zhf, turned.chosen);
    EXPECT_EQ(turned.shared->table.sha256, standard.shared->table.sha256);
}

TEST_F(OwnTables, a_chosen_table_is_named_as_it_was_typed_but_for_places_of_this_machine) {
    TableShelf shelf = project_tables();
    const auto name_of_chosen = [&](const fs::path& path) { return shelf.of_order(3, path).chosen->name; };
    const fs::path table = folder_ / "shared/order03.json";
    const fs::path here = fs::current_path();
    fs::current_path(bounds_.parent_path());  // not above the table
    EXPECT_EQ(name_of_chosen(table), "order03.json");
    fs::current_path(folder_);
    EXPECT_EQ(name_of_chosen(table), "shared/order03.json");
    EXPECT_EQ(name_of_chosen("shared/order03.json"), "shared/order03.json");
    EXPECT_EQ(name_of_chosen("band/../shared/order03.json"), "shared/order03.json");
    fs::current_path(here);
}

TEST_F(OwnTables, a_name_that_would_break_a_comment_is_refused) {
    const fs::path table = folder_ / "a\nint x = 0;.json";
    fs::copy_file(folder_ / "shared/order03.json", table);
    TableShelf shelf = project_tables();
    EXPECT_THAT(complaint_of([&] { shelf.of_order(3, table); }),
                AllOf(HasSubstr("found a control character in the name"), HasSubstr("rename")));
}

TEST_F(OwnTables, an_order_without_lobes_takes_no_table) {
    TableShelf shelf = project_tables();
    EXPECT_THAT(complaint_of([&] { shelf.of_order(2, folder_ / "shared/order03.json"); }),
                AllOf(HasSubstr("found with order 2"), HasSubstr("drop --table"), Not(HasSubstr("search"))));
}

}  // namespace
}  // namespace zonal
