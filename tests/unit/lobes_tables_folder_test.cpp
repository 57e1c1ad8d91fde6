#include <gtest/gtest.h>

#include <cstdlib>

#include "lobes/tables_folder.hpp"

namespace {

TEST(tables_folder, program_of_a_build_reads_the_source) {
    unsetenv("ZONAL_TABLES_DIR");
    EXPECT_EQ(zonal::tables_folder(), std::filesystem::path(ZONAL_TABLES_DIR));
}

TEST(tables_folder, environment_comes_first_unless_empty) {
    setenv("ZONAL_TABLES_DIR", "/elsewhere/tables", 1);
    EXPECT_EQ(zonal::tables_folder(), std::filesystem::path("/elsewhere/tables"));
    setenv("ZONAL_TABLES_DIR", "", 1);
    EXPECT_EQ(zonal::tables_folder(), std::filesystem::path(ZONAL_TABLES_DIR));
    unsetenv("ZONAL_TABLES_DIR");
}

}  // namespace
