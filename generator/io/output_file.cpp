#include "io/output_file.hpp"

#include <fmt/format.h>

#include <fstream>

#include "io/user_error.hpp"

namespace zonal {

void write_file_atomically(const std::filesystem::path& path, const std::string& content) {
    namespace fs = std::filesystem;
    const fs::path temporary = path.string() + ".tmp";
    const auto fail = [&](const std::string& reason) {
        std::error_code ignored;
        fs::remove(temporary, ignored);
        throw UserError(fmt::format("{}: cannot write: {}; choose another folder or mend its permissions",
                                    path.string(), reason));
    };
    std::error_code error;
    if (path.has_parent_path()) fs::create_directories(path.parent_path(), error);
    if (error) fail(error.message());
    {
        std::ofstream stream(temporary, std::ios::binary);
        stream << content;
        stream.close();
        if (!stream) fail("the file could not be opened or the disk is full");
    }
    fs::rename(temporary, path, error);
    if (error) fail(error.message());
}

void check_is_writable(const std::string& option, const std::filesystem::path& path) {
    const std::filesystem::path probe = path.string() + ".probe";
    try {
        write_file_atomically(probe, "");
    } catch (const UserError&) {
        throw UserError(
            fmt::format("{} {}: nothing can be written beside it; mend the permissions of its "
                        "folder or choose another file",
                        option, path.string()));
    }
    std::filesystem::remove(probe);
}

}  // namespace zonal
