// Reads Radiance pictures (.hdr) through stb_image.
//
// stb_image takes zeros for the bytes past the end of a file without a word, and the version in Debian 12
// loops for ever when such a zero is the length of a run. So it reads through callbacks that hand out line
// ends past the end (an empty line ends the header, and as a number 10 is a run that makes progress), which
// lets it finish, and remember that they did.
#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#include <stb_image.h>

#include <cstring>
#include <fstream>
#include <memory>

#include "image_readers.hpp"
#include "zonal/error.hpp"

namespace zonal {
namespace {

struct Source {
    std::ifstream stream;
    bool is_truncated = false;
};

/// What stb_image asks for when it fills its buffer; it asks for less only when it needs every byte of it.
constexpr int kBufferSize = 128;

int read(void* user, char* data, int size) {
    Source& source = *static_cast<Source*>(user);
    source.stream.read(data, size);
    const int count = static_cast<int>(source.stream.gcount());
    if (count == size || (count > 0 && size == kBufferSize)) return count;
    source.is_truncated = true;
    std::memset(data + count, '\n', size - count);
    return size;
}

void skip(void* user, int count) { static_cast<Source*>(user)->stream.ignore(count); }

int is_at_end(void* user) { return static_cast<Source*>(user)->is_truncated ? 1 : 0; }

const stbi_io_callbacks kCallbacks{read, skip, is_at_end};

[[noreturn]] void fail(const std::filesystem::path& path, const std::string& reason) {
    throw Error({.file = path.string(),
                 .field = "Radiance HDR data",
                 .found = "a truncated, corrupt or unsupported file (" + reason + ")",
                 .wanted = "a complete picture",
                 .next_step = "fetch or export the file again"});
}

}  // namespace

DecodedMap read_radiance(const std::filesystem::path& path) {
    int width = 0, height = 0, channels = 0;
    Source header{std::ifstream(path, std::ios::binary)};
    const bool is_read = stbi_info_from_callbacks(&kCallbacks, &header, &width, &height, &channels) != 0;
    if (!is_read || header.is_truncated) fail(path, "its header cannot be read");
    EnvironmentMap map = black_map_for_file(path, width, height);  // before stb_image claims memory

    Source source{std::ifstream(path, std::ios::binary)};
    const std::unique_ptr<float, decltype(&stbi_image_free)> texels(
        stbi_loadf_from_callbacks(&kCallbacks, &source, &width, &height, &channels, 3), stbi_image_free);
    if (source.is_truncated) fail(path, "it ends too early");
    if (!texels) fail(path, stbi_failure_reason());
    const float* texel = texels.get();
    for (Rgb<float>& value : map.texels) {
        value = {texel[0], texel[1], texel[2]};
        texel += 3;
    }
    return {std::move(map), false};
}

}  // namespace zonal
