#pragma once

#include <filesystem>
#include <string>

namespace zonal {

/// Writes `content` under a temporary name that nobody has in the same folder, then renames it onto `path`,
/// making folders as needed: a failed run leaves the old file and no half one. A link stays, and the file it
/// names is written; an existing file keeps its mode. Throws `UserError` naming the path and the system's
/// reason, also for what is there and is not a regular file (a folder, a device, a name of an open file under
/// /proc).
void write_file_atomically(const std::filesystem::path& path, const std::string& content);

/// For the beginning of long work: throws `UserError`, which names the option, unless `path` could be
/// written; makes a file of another name beside it to know, and removes it. Touches no other file.
void check_is_writable(const std::string& option, const std::filesystem::path& path);

/// Whether both names, through links, are of one file, which need not be there yet.
bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b);

/// Keeps other processes that hold such a lock out while a file is read and written again: `flock` of its
/// folder, which is made as needed, so that no file of locks is left behind. Throws `UserError`.
class OutputLock {
  public:
    explicit OutputLock(const std::filesystem::path& path);
    ~OutputLock();
    OutputLock(const OutputLock&) = delete;
    OutputLock& operator=(const OutputLock&) = delete;

  private:
    int folder_ = -1;
};

}  // namespace zonal
