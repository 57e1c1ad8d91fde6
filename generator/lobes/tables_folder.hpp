#pragma once

#include <filesystem>

namespace zonal {

/// The folder of the tables and bounds that come with the program, the first of
///   1. the environment variable ZONAL_TABLES_DIR, where it is set and not empty;
///   2. share/zonal/tables of the prefix the program is installed under, wherever that was moved;
///   3. generator/tables of the source it was built from.
/// Not checked beyond that: whoever reads a table names the file that is missing.
std::filesystem::path tables_folder();

}  // namespace zonal
