#include "io/output_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>

#include "io/user_error.hpp"

namespace zonal {
namespace {

namespace fs = std::filesystem;

constexpr int kMostLinks = 40;  // as many as Linux follows

struct Unwritable {
    std::string reason;
};

[[noreturn]] void fail_to_write(int error) { throw Unwritable{std::generic_category().message(error)}; }

fs::path folder_of(const fs::path& path) { return path.has_parent_path() ? path.parent_path() : "."; }

/// Names under it stand for open files and the system's state: a file renamed there, or onto what such a name
/// leads to, would be lost to who holds it open.
void check_is_no_system_name(const fs::path& path) {
    const fs::path folder = fs::weakly_canonical(fs::absolute(folder_of(path))).relative_path();
    if (folder.empty()) return;
    if (*folder.begin() == "proc" || *folder.begin() == "sys")
        throw Unwritable{"it is not a regular file, but a name of the system"};
}

/// The file behind the links of `path`; the last link may name a file that is not there yet.
fs::path behind_links(fs::path path) {
    if (path.empty()) throw Unwritable{"the name is empty"};
    for (int links = 0; fs::is_symlink(fs::symlink_status(path)); ++links) {
        check_is_no_system_name(path);
        if (links == kMostLinks) fail_to_write(ELOOP);
        path = path.parent_path() / fs::read_symlink(path);
    }
    check_is_no_system_name(path);
    return path;
}

/// The folder that is there already of those that lead to `target`. Throws unless a file could be put there,
/// as far as that is known without trying.
fs::path check_target(const fs::path& target) {
    struct stat there {};
    if (stat(target.c_str(), &there) == 0) {
        if (S_ISDIR(there.st_mode)) fail_to_write(EISDIR);
        if (!S_ISREG(there.st_mode)) throw Unwritable{"it is not a regular file"};
    } else if (errno != ENOENT) {
        fail_to_write(errno);
    }
    if (!target.has_filename()) fail_to_write(EISDIR);
    fs::path folder = folder_of(target);  // folders that are not there yet will be made
    while (stat(folder.c_str(), &there) != 0) {
        if (errno != ENOENT) fail_to_write(errno);
        folder = folder_of(folder);
    }
    if (!S_ISDIR(there.st_mode)) fail_to_write(ENOTDIR);
    if (access(folder.c_str(), W_OK | X_OK) != 0) fail_to_write(errno);
    return folder;
}

/// The mode of the file at `target`, or the one a new file gets.
mode_t mode_for(const fs::path& target) {
    struct stat there {};
    if (stat(target.c_str(), &there) == 0) return there.st_mode & 07777;
    const mode_t mask = umask(0);
    umask(mask);
    return 0666 & ~mask;
}

/// A new file beside `target`; removed unless it takes the target's place.
class TemporaryFile {
  public:
    explicit TemporaryFile(const fs::path& target)
        : name_((folder_of(target) / ".zonal-XXXXXX").string()), descriptor_(mkstemp(name_.data())) {
        if (descriptor_ < 0) fail_to_write(errno);
    }
    ~TemporaryFile() {
        if (descriptor_ >= 0) close(descriptor_);
        if (!is_placed_) unlink(name_.c_str());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    void write_all(const std::string& content) const {
        for (std::size_t done = 0; done < content.size();) {
            const ssize_t count = write(descriptor_, content.data() + done, content.size() - done);
            if (count >= 0)
                done += static_cast<std::size_t>(count);
            else if (errno != EINTR)
                fail_to_write(errno);
        }
    }

    void replace(const fs::path& target) {
        if (fchmod(descriptor_, mode_for(target)) != 0) fail_to_write(errno);
        const int descriptor = descriptor_;
        descriptor_ = -1;
        if (close(descriptor) != 0) fail_to_write(errno);
        if (rename(name_.c_str(), target.c_str()) != 0) fail_to_write(errno);
        is_placed_ = true;
    }

  private:
    std::string name_;
    int descriptor_;
    bool is_placed_ = false;
};

/// Does `work`; what goes wrong becomes a `UserError` about `name`.
template <class Work>
void or_complain(const std::string& name, const Work& work) {
    std::string reason;
    try {
        return work();
    } catch (const Unwritable& error) {
        reason = error.reason;
    } catch (const fs::filesystem_error& error) {
        reason = error.code().message();
    }
    throw UserError(fmt::format("{}: cannot write: {}; name another file, or mend its folder", name, reason));
}

}  // namespace

void write_file_atomically(const fs::path& path, const std::string& content) {
    or_complain(path.string(), [&] {
        const fs::path target = behind_links(path);
        check_target(target);
        fs::create_directories(folder_of(target));
        TemporaryFile file(target);
        file.write_all(content);
        file.replace(target);
    });
}

void check_is_writable(const std::string& option, const fs::path& path) {
    or_complain(option + ' ' + path.string(), [&] {
        const fs::path folder = check_target(behind_links(path));
        const TemporaryFile trial(folder / "trial");
    });
}

bool is_same_file(const fs::path& a, const fs::path& b) {
    bool is_same = false;
    or_complain(a.string(), [&] {
        is_same = fs::weakly_canonical(fs::absolute(behind_links(a))) ==
                  fs::weakly_canonical(fs::absolute(behind_links(b)));
    });
    return is_same;
}

OutputLock::OutputLock(const fs::path& path) {
    or_complain(path.string(), [&] {
        const fs::path folder = folder_of(behind_links(path));
        fs::create_directories(folder);
        folder_ = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (folder_ < 0) fail_to_write(errno);
        while (flock(folder_, LOCK_EX) != 0) {
            if (errno == EINTR) continue;
            const int error = errno;
            close(folder_);
            fail_to_write(error);
        }
    });
}

OutputLock::~OutputLock() { close(folder_); }

}  // namespace zonal
