#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>

#include <exception>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "image_readers.hpp"
#include "zonal/error.hpp"

namespace zonal {
namespace {

void check_channels(const std::filesystem::path& path, const Imf::ChannelList& channels) {
    std::string names;
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        names += names.empty() ? channel.name() : joined(", ", channel.name());
    }
    for (const char* wanted : {"R", "G", "B"}) {
        if (channels.findChannel(wanted) != nullptr) continue;
        throw Error({.file = path.string(),
                     .field = joined("channel ", wanted),
                     .found = joined("only channels ", names.empty() ? "(none)" : names),
                     .wanted = "channels R, G and B",
                     .next_step = "export the map as RGB"});
    }
}

DecodedMap decode_openexr(const std::filesystem::path& path) {
    Imf::InputFile file(path.c_str());
    const Imf::Header& header = file.header();
    check_channels(path, header.channels());
    const Imath::Box2i window = header.dataWindow();
    EnvironmentMap map =
        black_map_for_file(path, window.max.x - window.min.x + 1, window.max.y - window.min.y + 1);

    const std::size_t texel_stride = sizeof(Rgb<float>);
    const std::size_t row_stride = texel_stride * map.width;
    Rgb<float>& first = map.texels.front();
    // Slice::Make is told the window, so that no pointer outside the array is formed.
    const auto slice = [&](float& channel) {
        return Imf::Slice::Make(Imf::FLOAT, &channel, window, texel_stride, row_stride);
    };
    Imf::FrameBuffer frame_buffer;
    frame_buffer.insert("R", slice(first.r));
    frame_buffer.insert("G", slice(first.g));
    frame_buffer.insert("B", slice(first.b));
    file.setFrameBuffer(frame_buffer);
    file.readPixels(window.min.y, window.max.y);

    const Imf::Compression compression = header.compression();
    return {std::move(map), compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION};
}

}  // namespace

DecodedMap read_openexr(const std::filesystem::path& path) {
    try {
        return decode_openexr(path);
    } catch (const Error&) {
        throw;
    } catch (const std::exception& exception) {  // OpenEXR's own, and std::bad_alloc for an absurd size
        throw Error({.file = path.string(),
                     .field = "OpenEXR data",
                     .found = joined("a truncated, corrupt or unsupported file (", exception.what(), ")"),
                     .wanted = "a complete single-part image",
                     .next_step = "fetch or export the file again"});
    }
}

}  // namespace zonal
