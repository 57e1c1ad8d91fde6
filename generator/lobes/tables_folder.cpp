#include "lobes/tables_folder.hpp"

#include <cstdlib>
#include <system_error>

namespace zonal {
namespace {

/// Where the running program lies; empty where the system does not tell (outside Linux).
std::filesystem::path program_folder() {
    std::error_code error;
    const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
    return error ? std::filesystem::path() : program.parent_path();
}

}  // namespace

std::filesystem::path tables_folder() {
    const char* chosen = std::getenv("ZONAL_TABLES_DIR");
    if (chosen != nullptr && *chosen != '\0') return chosen;
    const std::filesystem::path program = program_folder();
    const std::filesystem::path installed = (program / ZONAL_TABLES_FROM_PROGRAM).lexically_normal();
    if (!program.empty() && std::filesystem::is_directory(installed)) return installed;
    return ZONAL_SOURCE_TABLES;
}

}  // namespace zonal
