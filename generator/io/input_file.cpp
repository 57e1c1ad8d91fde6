#include "io/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace zonal {
namespace {

constexpr std::size_t kMostBytes = std::size_t{64} << 20U;

[[noreturn]] void fail_to_read(int error) { throw Unreadable(std::generic_category().message(error)); }

/// Closes its file.
struct Descriptor {
    int number;
    ~Descriptor() { close(number); }
};

}  // namespace

std::string read_file(const std::filesystem::path& path) {
    const int opened = open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (opened < 0) fail_to_read(errno);
    const Descriptor file{opened};
    struct stat there {};
    if (fstat(file.number, &there) != 0) fail_to_read(errno);
    if (S_ISDIR(there.st_mode)) throw Unreadable("it is a folder");
    if (!S_ISREG(there.st_mode) && !S_ISFIFO(there.st_mode)) throw Unreadable("it is not a regular file");
    std::string bytes;
    char block[1 << 16];
    for (;;) {
        const ssize_t count = read(file.number, block, sizeof block);
        if (count == 0) return bytes;
        if (count < 0 && errno != EINTR) fail_to_read(errno);
        if (count > 0) bytes.append(block, static_cast<std::size_t>(count));
        if (bytes.size() > kMostBytes) throw Unreadable("it is larger than 64 MiB");
    }
}

}  // namespace zonal
