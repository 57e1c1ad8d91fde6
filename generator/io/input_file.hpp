#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

namespace zonal {

/// Why a file cannot be read: "No such file or directory", "it is a folder".
struct Unreadable : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The bytes of a file, or of a pipe. Throws `Unreadable`, also for what has more bytes than any file of this
/// program.
std::string read_file(const std::filesystem::path& path);

}  // namespace zonal
