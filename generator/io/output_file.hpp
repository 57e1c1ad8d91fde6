#pragma once

#include <filesystem>
#include <string>

namespace zonal {

/// Writes `content` under a temporary name in the same folder, then renames it onto `path`, making folders as
/// needed: a failed run leaves the old file and no half one. Throws `UserError` naming the path and the
/// reason.
void write_file_atomically(const std::filesystem::path& path, const std::string& content);

/// For the beginning of long work: throws `UserError`, which names the option, unless `path` could be
/// written.
void check_is_writable(const std::string& option, const std::filesystem::path& path);

}  // namespace zonal
