#pragma once

#include <span>
#include <string>

namespace zonal::gpu {

/// SHA-256 of what decides whether a case passes.
class Fingerprint {
  public:
    Fingerprint();
    ~Fingerprint();
    Fingerprint(const Fingerprint&) = delete;
    void add(const std::string& text);
    template <class T>
    void add(std::span<const T> values) {
        add_bytes(values.data(), values.size_bytes());
    }
    /// Its first 32 hexadecimal digits.
    std::string text() const;

  private:
    void add_bytes(const void* bytes, std::size_t size);
    void* context_;
};

/// The sources that run and judge a case (ZONAL_HEAVY_SOURCES), without lines of comment.
std::string judging_sources();

/// Whether the committed record (ZONAL_HEAVY_RECORD) says that this case passed with this fingerprint. Throws
/// std::runtime_error with the file's name where it is no record.
bool has_passed(const std::string& name, const std::string& fingerprint);

/// Puts a case that has just passed into the record, if the environment variable ZONAL_RECORD_HEAVY is 1.
void record_pass(const std::string& name, const std::string& fingerprint);

}  // namespace zonal::gpu
