#pragma once

#include <filesystem>
#include <string>

namespace zonal {

/// Writes `content` under a temporary name that nobody has in the same folder, then renames it onto `path`,
/// making folders as needed: a failed run leaves the old file and no half one. A link stays, and the file it
/// names is written; an existing file keeps its mode. Throws `UserError` naming the path and the system's
/// reason, also for what is there and is not a regular file (a folder, a device).
void write_file_atomically(const std::filesystem::path& path, const std::string& content);

/// For the beginning of long work: throws `UserError`, which names the option, unless `path` could be
/// written. Leaves nothing behind and touches no file.
void check_is_writable(const std::string& option, const std::filesystem::path& path);

}  // namespace zonal
