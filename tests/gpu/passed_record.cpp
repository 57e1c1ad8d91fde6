// Cases whose shaders a driver compiles for minutes are run once for each shader, judge and driver: a file
// beside the tests holds the fingerprint that each passed with.

#include "gpu/passed_record.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/evp.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace zonal::gpu {

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& file) {
    std::ifstream stream(file);
    if (!stream) throw std::runtime_error(file.string() + ": cannot be read");
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

nlohmann::ordered_json read_record(const fs::path& file) {
    if (!fs::exists(file)) return nlohmann::ordered_json::object();
    try {
        auto record = nlohmann::ordered_json::parse(text_of(file));
        for (const auto& [name, fingerprint] : record.items()) fingerprint.get<std::string>();
        return record;
    } catch (const nlohmann::json::exception& error) {
        throw std::runtime_error(fmt::format("{}: {}; delete it, then run with ZONAL_RECORD_HEAVY=1",
                                             file.string(), error.what()));
    }
}

/// Several tests may record at one time.
class Lock {
  public:
    explicit Lock(const fs::path& file)
        : descriptor_(::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644)) {
        if (descriptor_ < 0 || ::flock(descriptor_, LOCK_EX) != 0)
            throw std::runtime_error(file.string() + ": cannot be locked");
    }
    ~Lock() { ::close(descriptor_); }
    Lock(const Lock&) = delete;

  private:
    int descriptor_;
};

}  // namespace

Fingerprint::Fingerprint() : context_(EVP_MD_CTX_new()) {
    EVP_DigestInit_ex(static_cast<EVP_MD_CTX*>(context_), EVP_sha256(), nullptr);
}

Fingerprint::~Fingerprint() { EVP_MD_CTX_free(static_cast<EVP_MD_CTX*>(context_)); }

void Fingerprint::add_bytes(const void* bytes, std::size_t size) {
    // With its length, so that no two lists of parts give the same bytes.
    EVP_DigestUpdate(static_cast<EVP_MD_CTX*>(context_), &size, sizeof size);
    EVP_DigestUpdate(static_cast<EVP_MD_CTX*>(context_), bytes, size);
}

void Fingerprint::add(const std::string& text) { add_bytes(text.data(), text.size()); }

std::string Fingerprint::text() const {
    unsigned char digest[EVP_MAX_MD_SIZE];
    EVP_MD_CTX* copy = EVP_MD_CTX_new();
    EVP_MD_CTX_copy_ex(copy, static_cast<const EVP_MD_CTX*>(context_));
    EVP_DigestFinal_ex(copy, digest, nullptr);
    EVP_MD_CTX_free(copy);
    return fmt::format("{:02x}", fmt::join(digest, digest + 16, ""));
}

std::string judging_sources() {
    std::string all;
    std::istringstream files(ZONAL_HEAVY_SOURCES);
    for (std::string file; std::getline(files, file, ':');) {
        std::istringstream lines(text_of(file));
        for (std::string line; std::getline(lines, line);) {
            const std::size_t first = line.find_first_not_of(' ');
            if (first == std::string::npos || line.compare(first, 2, "//") == 0) continue;
            all += line + '\n';
        }
    }
    return all;
}

bool has_passed(const std::string& name, const std::string& fingerprint) {
    const auto record = read_record(ZONAL_HEAVY_RECORD);
    return record.contains(name) && record.at(name) == fingerprint;
}

void record_pass(const std::string& name, const std::string& fingerprint) {
    const char* wanted = std::getenv("ZONAL_RECORD_HEAVY");
    if (wanted == nullptr || std::string(wanted) != "1") return;
    const fs::path file = ZONAL_HEAVY_RECORD;
    const Lock lock(fs::path(ZONAL_HEAVY_LOCK));
    auto record = nlohmann::json(read_record(file));  // sorted by name
    record[name] = fingerprint;
    const fs::path fresh = file.string() + ".tmp";
    std::ofstream stream(fresh);
    stream << record.dump(1) << '\n';
    stream.close();
    if (!stream) throw std::runtime_error(fresh.string() + ": cannot be written");
    fs::rename(fresh, file);
}

}  // namespace zonal::gpu
