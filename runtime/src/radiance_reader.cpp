// Reads Radiance pictures (.hdr) through stb_image.
//
// stb_image takes zeros for the bytes past the end of a file without a word, and the version in Debian 12 loops
// for ever when such a zero is the length of a run. So it reads through callbacks that hand out ones past the
// end, which lets it finish, and remember that they did.
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
    std::memset(data + count, 1, size - count);
    return size;
}

void skip(void* user, int count) { static_cast<Source*>(user)->stream.ignore(count); }

int is_at_end(void* user) { return static_cast<Source*>(user)->is_truncated ? 1 : 0; }

}  // namespace

DecodedMap read_radiance(const std::filesystem::path& path) {
    Source source{std::ifstream(path, std::ios::binary)};
    const stbi_io_callbacks callbacks{read, skip, is_at_end};
    int width = 0, height = 0, channels = 0;
    const std::unique_ptr<float, decltype(&stbi_image_free)> texels(
        stbi_loadf_from_callbacks(&callbacks, &source, &width, &height, &channels, 3), stbi_image_free);
    if (!texels || source.is_truncated)
        throw Error({.file = path.string(),
                     .field = "Radiance HDR data",
                     .found = std::string("a truncated, corrupt or unsupported file (") +
                              (texels ? "it ends too early" : stbi_failure_reason()) + ")",
                     .wanted = "a complete picture",
                     .next_step = "fetch or export the file again"});
    EnvironmentMap map = black_map_for_file(path, width, height);
    const float* texel = texels.get();
    for (Rgb<float>& value : map.texels) {
        value = {texel[0], texel[1], texel[2]};
        texel += 3;
    }
    return {std::move(map), false};
}

}  // namespace zonal
