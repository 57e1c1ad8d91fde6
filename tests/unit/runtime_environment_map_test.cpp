#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "zonal/eigen.hpp"
#include "zonal/environment_map.hpp"
#include "zonal/error.hpp"

namespace {

static_assert(std::endian::native == std::endian::little, "the files below are written in native byte order");

std::filesystem::path studio_path() { return std::filesystem::path(ZONAL_TEST_DATA) / "studio.exr"; }

std::filesystem::path write_file(const std::string& name, const std::string& bytes) {
    const std::filesystem::path path = std::filesystem::path(testing::TempDir()) / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

std::string bytes_of(const std::filesystem::path& path) {
    std::ifstream stream(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

std::string message_of_reading(const std::filesystem::path& path) {
    try {
        zonal::read_environment_map(path);
    } catch (const zonal::Error& error) {
        return error.what();
    }
    return "no error";
}

template <class T>
std::string raw(T value) {
    return {reinterpret_cast<const char*>(&value), sizeof(T)};
}

/// An uncompressed OpenEXR file of float channels, written by hand so that the reader is judged by the
/// format. `channels` are single letters in alphabetical order; `values` lie row by row, channel by channel,
/// as in the file.
std::string exr_bytes(int width, int height, const std::string& channels, const std::vector<float>& values) {
    const auto attribute = [](const std::string& name, const std::string& type, const std::string& value) {
        return name + '\0' + type + '\0' + raw(static_cast<std::int32_t>(value.size())) + value;
    };
    std::string list;
    for (const char channel : channels) {
        constexpr std::int32_t kFloat = 2;
        list += std::string{channel, '\0'} + raw(kFloat) + raw(std::int32_t{0}) + raw(std::int32_t{1}) +
                raw(std::int32_t{1});
    }
    list += '\0';
    const std::string window = raw(std::int32_t{0}) + raw(std::int32_t{0}) + raw(std::int32_t{width - 1}) +
                               raw(std::int32_t{height - 1});
    std::string file = "\x76\x2f\x31\x01" + raw(std::int32_t{2});
    file += attribute("channels", "chlist", list);
    file += attribute("compression", "compression", std::string(1, '\0'));
    file += attribute("dataWindow", "box2i", window);
    file += attribute("displayWindow", "box2i", window);
    file += attribute("lineOrder", "lineOrder", std::string(1, '\0'));
    file += attribute("pixelAspectRatio", "float", raw(1.0F));
    file += attribute("screenWindowCenter", "v2f", raw(0.0F) + raw(0.0F));
    file += attribute("screenWindowWidth", "float", raw(1.0F));
    file += '\0';

    const std::size_t row_values = channels.size() * static_cast<std::size_t>(width);
    const std::size_t block = 2 * sizeof(std::int32_t) + row_values * sizeof(float);
    const std::size_t first_block = file.size() + static_cast<std::size_t>(height) * sizeof(std::uint64_t);
    for (int row = 0; row < height; ++row) file += raw(static_cast<std::uint64_t>(first_block + row * block));
    for (int row = 0; row < height; ++row) {
        file += raw(std::int32_t{row}) + raw(static_cast<std::int32_t>(row_values * sizeof(float)));
        for (std::size_t i = 0; i < row_values; ++i) file += raw(values[row * row_values + i]);
    }
    return file;
}

/// 4 x 2 texels; blue, green, red of a row one after the other.
constexpr int kWidth = 4;
constexpr int kHeight = 2;
constexpr std::size_t kGreenOfRow1 = 3 * kWidth + kWidth;

std::vector<float> small_values() {
    std::vector<float> values(3 * kWidth * kHeight);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = 0.5F * static_cast<float>(i);
    return values;
}

std::string message_of_small_exr_with(const std::string& name, float green_at_column_2_row_1) {
    std::vector<float> values = small_values();
    values[kGreenOfRow1 + 2] = green_at_column_2_row_1;
    return message_of_reading(write_file(name, exr_bytes(kWidth, kHeight, "BGR", values)));
}

/// A Radiance picture; the texels follow plain or run-length coded.
std::string hdr_bytes(int width, int height, const std::string& texels) {
    return "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
           std::to_string(width) + "\n" + texels;
}

/// Red, green, blue mantissas over 256 times 2^(exponent - 128).
std::string rgbe(int r, int g, int b, int exponent) {
    return {static_cast<char>(r), static_cast<char>(g), static_cast<char>(b), static_cast<char>(exponent)};
}

std::string small_hdr_texels() {
    std::string texels;
    for (int i = 0; i < kWidth * kHeight; ++i) texels += rgbe(128 + i, 64, 32, 129);
    return texels;
}

/// One row of 8 texels as Radiance codes it: a mark, the width, then each byte of the texel as one run.
std::string hdr_coded_row(int r, int g, int b, int exponent) {
    const char run_of_8 = static_cast<char>(128 + 8);
    std::string row = {2, 2, 0, 8};
    for (const int value : {r, g, b, exponent}) row += std::string{run_of_8, static_cast<char>(value)};
    return row;
}

TEST(runtime_environment_map, corner_and_middle_texels_look_where_the_convention_says) {
    // One row of four: theta = 90 degrees, phi = 45, 135, 225, 315 degrees.
    const double h = std::numbers::sqrt2 / 2;
    const std::array<Eigen::Vector3d, 4> wanted = {{{h, h, 0}, {-h, h, 0}, {-h, -h, 0}, {h, -h, 0}}};
    for (int column = 0; column < 4; ++column) {
        EXPECT_TRUE(zonal::to_eigen(zonal::texel_direction(4, 1, column, 0)).isApprox(wanted[column], 1e-15))
            << column;
    }
    EXPECT_GT(zonal::texel_direction(1024, 512, 0, 0).z, 0.99);
    EXPECT_LT(zonal::texel_direction(1024, 512, 0, 511).z, -0.99);
    EXPECT_GT(zonal::texel_direction(1024, 512, 256, 256).y, 0.99);
}

TEST(runtime_environment_map, studio_map_is_read_whole) {
    const zonal::EnvironmentMap map = zonal::read_environment_map(studio_path());
    EXPECT_EQ(map.width, 1024);
    EXPECT_EQ(map.height, 512);
    EXPECT_EQ(map.texels.size(), 1024U * 512U);
    EXPECT_EQ(zonal::largest_value(map), 118.375F);
}

TEST(runtime_environment_map, exr_channels_and_texels_keep_their_places) {
    const auto path = write_file("places.exr", exr_bytes(kWidth, kHeight, "BGR", small_values()));
    const zonal::EnvironmentMap map = zonal::read_environment_map(path);
    const std::vector<float> values = small_values();
    for (int row = 0; row < kHeight; ++row) {
        for (int column = 0; column < kWidth; ++column) {
            const std::size_t blue = 3 * kWidth * row + column;
            EXPECT_EQ(map.at(column, row),
                      (zonal::Rgb<float>{values[blue + 2 * kWidth], values[blue + kWidth], values[blue]}));
        }
    }
}

TEST(runtime_environment_map, format_is_told_by_content_not_by_name) {
    const auto path = write_file("really_radiance.exr", hdr_bytes(kWidth, kHeight, small_hdr_texels()));
    const zonal::EnvironmentMap map = zonal::read_environment_map(path);
    EXPECT_EQ(map.width, kWidth);
    EXPECT_EQ(map.height, kHeight);
    EXPECT_EQ(map.at(0, 0), (zonal::Rgb<float>{1.0F, 0.5F, 0.25F}));
    EXPECT_EQ(map.at(3, 1), (zonal::Rgb<float>{135.0F / 128, 0.5F, 0.25F}));
}

TEST(runtime_environment_map, run_length_coded_hdr_is_read) {
    std::string rows;
    for (int row = 0; row < 4; ++row) rows += hdr_coded_row(128, 64, 32, 129 + row);
    const auto map = zonal::read_environment_map(write_file("coded.hdr", hdr_bytes(8, 4, rows)));
    EXPECT_EQ(map.at(7, 0), (zonal::Rgb<float>{1.0F, 0.5F, 0.25F}));
    EXPECT_EQ(map.at(0, 3), (zonal::Rgb<float>{8.0F, 4.0F, 2.0F}));
}

TEST(runtime_environment_map, missing_file_is_named) {
    const std::string message = message_of_reading("no/such/map.exr");
    EXPECT_NE(message.find("no/such/map.exr: file: found no such file"), std::string::npos) << message;
}

TEST(runtime_environment_map, folder_is_refused) {
    EXPECT_NE(message_of_reading(testing::TempDir()).find("not a regular file"), std::string::npos);
}

TEST(runtime_environment_map, empty_and_foreign_files_are_refused) {
    EXPECT_NE(message_of_reading(write_file("empty.exr", "")).find("an empty file"), std::string::npos);
    const std::string message = message_of_reading(write_file("text.exr", "not a picture at all"));
    EXPECT_NE(message.find("text.exr: first bytes"), std::string::npos) << message;
    EXPECT_NE(message.find("wanted OpenEXR or Radiance HDR"), std::string::npos) << message;
}

TEST(runtime_environment_map, truncated_exr_is_refused_wherever_it_ends) {
    const std::string whole = bytes_of(studio_path());
    ASSERT_GT(whole.size(), 10000U);
    for (const std::size_t kept :
         {std::size_t{5}, std::size_t{100}, std::size_t{1000}, whole.size() / 2, whole.size() - 1}) {
        const std::string message = message_of_reading(write_file("truncated.exr", whole.substr(0, kept)));
        EXPECT_NE(message.find("truncated.exr: OpenEXR data: found a truncated, corrupt"), std::string::npos)
            << kept << " bytes kept: " << message;
    }
}

TEST(runtime_environment_map, truncated_hdr_is_refused_wherever_it_ends) {
    std::string coded_rows;
    for (int row = 0; row < 4; ++row) coded_rows += hdr_coded_row(128, 64, 32, 129);
    const std::string coded = hdr_bytes(8, 4, coded_rows);
    const std::string flat = hdr_bytes(kWidth, kHeight, small_hdr_texels());
    for (const std::string& whole : {coded, flat}) {
        EXPECT_EQ(message_of_reading(write_file("truncated.hdr", whole)), "no error");
        for (std::size_t kept = 11; kept < whole.size(); ++kept) {
            const std::string message =
                message_of_reading(write_file("truncated.hdr", whole.substr(0, kept)));
            EXPECT_NE(message.find("truncated.hdr: Radiance HDR data"), std::string::npos)
                << kept << " of " << whole.size() << " bytes kept: " << message;
        }
    }
}

TEST(runtime_environment_map, image_that_is_not_two_to_one_is_refused) {
    const auto exr = write_file("square.exr", exr_bytes(2, 2, "BGR", small_values()));
    EXPECT_NE(message_of_reading(exr).find("square.exr: size: found 2 x 2 texels"), std::string::npos);
    const auto odd = write_file("odd.exr", exr_bytes(3, 1, "BGR", small_values()));
    EXPECT_NE(message_of_reading(odd).find("odd.exr: size: found 3 x 1 texels"), std::string::npos);
    const auto hdr = write_file("square.hdr", hdr_bytes(2, 4, small_hdr_texels()));
    EXPECT_NE(message_of_reading(hdr).find("square.hdr: size: found 2 x 4 texels"), std::string::npos);
}

TEST(runtime_environment_map, corrupt_hdr_is_refused_with_the_reason) {
    const std::string row = hdr_coded_row(128, 64, 32, 129);
    const auto message_with = [&](std::size_t at, char byte) {
        std::string rows = row + row + row + row;
        rows[at] = byte;
        return message_of_reading(write_file("corrupt.hdr", hdr_bytes(8, 4, rows)));
    };
    const std::string reason =
        "corrupt.hdr: Radiance HDR data: found a truncated, corrupt or unsupported file (";
    EXPECT_NE(message_with(4, 0).find(reason), std::string::npos);       // a run of length 0
    EXPECT_NE(message_with(4, '\xff').find(reason), std::string::npos);  // a run longer than its row
    EXPECT_NE(message_with(3, 9).find(reason), std::string::npos);       // a row marked with another width
    const auto turned = write_file("turned.hdr", "#?RGBE\nFORMAT=32-bit_rle_rgbe\n\n+X 8 -Y 4\n");
    EXPECT_NE(message_of_reading(turned).find("turned.hdr: Radiance HDR data"), std::string::npos);
    const auto xyz = write_file("xyz.hdr", "#?RGBE\nFORMAT=32-bit_rle_xyze\n\n-Y 4 +X 8\n");
    EXPECT_NE(message_of_reading(xyz).find("xyz.hdr: Radiance HDR data"), std::string::npos);
}

TEST(runtime_environment_map, absurd_size_is_refused_before_memory_is_claimed) {
    const auto path = write_file("absurd.hdr", hdr_bytes(200000, 100000, ""));
    EXPECT_NE(message_of_reading(path).find("absurd.hdr: size: found 200000 x 100000"), std::string::npos);
}

TEST(runtime_environment_map, bad_texel_is_named_with_place_channel_and_value) {
    const std::string place = ": texel at column 2, row 1, green: found ";
    const float infinity = std::numeric_limits<float>::infinity();
    EXPECT_NE(message_of_small_exr_with("nan.exr", std::nanf("")).find("nan.exr" + place + "nan"),
              std::string::npos);
    EXPECT_NE(message_of_small_exr_with("inf.exr", infinity).find("inf.exr" + place + "inf"),
              std::string::npos);
    EXPECT_NE(message_of_small_exr_with("negative.exr", -0.25F).find("negative.exr" + place + "-0.25"),
              std::string::npos);
}

TEST(runtime_environment_map, lossless_file_may_not_have_even_tiny_negative_texels) {
    EXPECT_NE(message_of_small_exr_with("tiny.exr", -1e-9F).find("found -1e-09"), std::string::npos);
}

TEST(runtime_environment_map, noise_of_dwa_below_zero_is_kept) {
    const zonal::EnvironmentMap map = zonal::read_environment_map(studio_path());
    float lowest = 0;
    for (const auto& texel : map.texels) lowest = std::min({lowest, texel.r, texel.g, texel.b});
    EXPECT_LT(lowest, 0.0F);
    EXPECT_GE(lowest, -1e-6F * zonal::largest_value(map));
}

TEST(runtime_environment_map, missing_channel_is_named_with_those_present) {
    const auto path = write_file("two.exr", exr_bytes(kWidth, kHeight, "BR", small_values()));
    const std::string message = message_of_reading(path);
    EXPECT_NE(message.find("two.exr: channel G: found only channels B, R"), std::string::npos) << message;
}

TEST(runtime_environment_map, difference_is_absolute_and_scaled) {
    zonal::EnvironmentMap a = zonal::black_map(1);
    zonal::EnvironmentMap b = zonal::black_map(1);
    a.at(0, 0) = {1, 5, 2};
    b.at(0, 0) = {3, 4, 2};
    const zonal::EnvironmentMap difference = zonal::absolute_difference(a, b, 10);
    EXPECT_EQ(difference.at(0, 0), (zonal::Rgb<float>{20, 10, 0}));
    EXPECT_EQ(difference.at(1, 0), (zonal::Rgb<float>{0, 0, 0}));
}

}  // namespace
