// Decodes Radiance pictures (.hdr): a text header, then rows of RGBE texels, plain or with each byte
// run-length coded.
//
// Not left to stb_image: the version in Debian 12 reads zeros past the end of a file without a word, and
// loops for ever when such a zero is the length of a run. Source: Greg Ward, "Real Pixels", Graphics Gems II;
// the Radiance file formats, section "Picture File Format". Limits: rows from the top, columns from the left
// (-Y +X, what every map has); not the run coding of before 1991.

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "image_readers.hpp"
#include "zonal/error.hpp"

namespace zonal {
namespace {

using Rgbe = std::array<std::uint8_t, 4>;

constexpr int kRedOfOldRun = 1;    // (1, 1, 1, n) repeats the last texel in the old coding
constexpr int kShortestCoded = 8;  // widths that may be run-length coded
constexpr int kLongestCoded = 32767;

/// Hands out the bytes of a file in order; asking for more than there are is an error that names the file.
class ByteReader {
  public:
    explicit ByteReader(const std::filesystem::path& path) : path_(path) {
        std::ifstream stream(path, std::ios::binary);
        bytes_.assign(std::istreambuf_iterator<char>(stream), {});
    }

    std::uint8_t byte() {
        if (next_ == bytes_.size()) fail("it ends too early");
        return static_cast<std::uint8_t>(bytes_[next_++]);
    }

    Rgbe texel() { return {byte(), byte(), byte(), byte()}; }

    std::string line() {
        std::string text;
        for (char c = static_cast<char>(byte()); c != '\n'; c = static_cast<char>(byte())) text += c;
        return text;
    }

    [[noreturn]] void fail(const std::string& reason) const {
        throw Error({.file = path_.string(),
                     .field = "Radiance HDR data",
                     .found = fmt::format("a truncated, corrupt or unsupported file ({})", reason),
                     .wanted = "a complete picture",
                     .next_step = "fetch or export the file again"});
    }

  private:
    std::filesystem::path path_;
    std::string bytes_;
    std::size_t next_ = 0;
};

EnvironmentMap read_header(const std::filesystem::path& path, ByteReader& reader) {
    bool is_rgbe = false;
    for (std::string line = reader.line(); !line.empty(); line = reader.line()) {
        is_rgbe = is_rgbe || line == "FORMAT=32-bit_rle_rgbe";
    }
    if (!is_rgbe) reader.fail("its header lacks FORMAT=32-bit_rle_rgbe");
    const std::string resolution = reader.line();
    int width = 0;
    int height = 0;
    if (std::sscanf(resolution.c_str(), "-Y %9d +X %9d", &height, &width) != 2) {
        reader.fail(fmt::format("its resolution line reads '{}'", resolution));
    }
    return black_map_for_file(path, width, height);
}

/// One byte of every texel of a row, as runs: n <= 128 is followed by n values, n > 128 by one to use n - 128
/// times.
void read_coded_bytes(ByteReader& reader, std::vector<Rgbe>& row, std::size_t which) {
    for (std::size_t column = 0; column < row.size();) {
        const std::size_t code = reader.byte();
        const bool is_run = code > 128;
        const std::size_t count = is_run ? code - 128 : code;
        if (count == 0 || count > row.size() - column) reader.fail("a run does not fit its row");
        std::uint8_t value = is_run ? reader.byte() : std::uint8_t{0};
        for (std::size_t end = column + count; column < end; ++column) {
            if (!is_run) value = reader.byte();
            row[column][which] = value;
        }
    }
}

void read_row(ByteReader& reader, std::vector<Rgbe>& row) {
    const Rgbe first = reader.texel();
    const std::size_t width = row.size();
    const bool is_coded =
        width >= kShortestCoded && width <= kLongestCoded && first[0] == 2 && first[1] == 2 && first[2] < 128;
    if (is_coded) {
        if (256U * first[2] + first[3] != width) reader.fail("a row is marked with another width");
        for (std::size_t which = 0; which < first.size(); ++which) read_coded_bytes(reader, row, which);
        return;
    }
    row.front() = first;
    for (std::size_t column = 1; column < width; ++column) row[column] = reader.texel();
    for (const Rgbe& texel : row) {
        const bool is_old_run =
            texel[0] == kRedOfOldRun && texel[1] == kRedOfOldRun && texel[2] == kRedOfOldRun;
        if (is_old_run) reader.fail("it may use the run coding of before 1991");
    }
}

/// Mantissas over 256 times 2^(exponent - 128); exponent 0 is black.
Rgb<float> decoded(const Rgbe& texel) {
    if (texel[3] == 0) return {};
    const float scale = std::ldexp(1.0F, texel[3] - (128 + 8));
    return scale * Rgb<float>{static_cast<float>(texel[0]), static_cast<float>(texel[1]),
                              static_cast<float>(texel[2])};
}

}  // namespace

DecodedMap read_radiance(const std::filesystem::path& path) {
    ByteReader reader(path);
    EnvironmentMap map = read_header(path, reader);
    std::vector<Rgbe> row(map.width);
    for (int y = 0; y < map.height; ++y) {
        read_row(reader, row);
        for (int x = 0; x < map.width; ++x) map.at(x, y) = decoded(row[x]);
    }
    return {std::move(map), false};
}

}  // namespace zonal
