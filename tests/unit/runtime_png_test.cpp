#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "zonal/error.hpp"
#include "zonal/png.hpp"

namespace {

std::filesystem::path fresh_folder(const std::string& name) {
    const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / name;
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder);
    return folder;
}

std::string message_of_writing(const std::filesystem::path& path,
                               const std::vector<zonal::EnvironmentMap>& panels) {
    try {
        zonal::write_png(path, panels, 1.0F);
    } catch (const zonal::Error& error) {
        return error.what();
    }
    return "no error";
}

unsigned big_endian(const std::string& bytes, std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = 256 * value + static_cast<unsigned char>(bytes.at(at + i));
    return value;
}

TEST(runtime_png, srgb_curve_has_its_known_values) {
    EXPECT_EQ(zonal::srgb_byte(0.0F), 0);
    EXPECT_EQ(zonal::srgb_byte(1.0F), 255);
    EXPECT_EQ(zonal::srgb_byte(0.5F), 188);        // 255 (1.055 2^(-1/2.4) - 0.055) = 187.5 + 0.02
    EXPECT_EQ(zonal::srgb_byte(0.002F), 7);        // linear part: 255 12.92 0.002 = 6.59
    EXPECT_EQ(zonal::srgb_byte(0.2158605F), 128);  // middle of the scale
}

TEST(runtime_png, values_outside_the_scale_are_clamped) {
    EXPECT_EQ(zonal::srgb_byte(-3.0F), 0);
    EXPECT_EQ(zonal::srgb_byte(1e30F), 255);
    EXPECT_EQ(zonal::srgb_byte(std::nanf("")), 0);
}

TEST(runtime_png, panels_stand_side_by_side_and_no_temporary_stays) {
    const auto folder = fresh_folder("zonal_png_panels");
    zonal::write_png(folder / "two.png", std::vector{zonal::black_map(4), zonal::black_map(4)}, 1.0F);
    std::ifstream stream(folder / "two.png", std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(stream), {}};
    EXPECT_EQ(bytes.substr(1, 3), "PNG");
    EXPECT_EQ(big_endian(bytes, 16), 16U);  // width in the IHDR chunk
    EXPECT_EQ(big_endian(bytes, 20), 4U);   // height
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

TEST(runtime_png, exposure_changes_the_picture) {
    const auto folder = fresh_folder("zonal_png_exposure");
    zonal::EnvironmentMap grey = zonal::black_map(1);
    grey.at(0, 0) = {0.25F, 0.25F, 0.25F};
    const std::vector panels = {grey};
    const auto bytes_at = [&](float exposure) {
        zonal::write_png(folder / "grey.png", panels, exposure);
        std::ifstream stream(folder / "grey.png", std::ios::binary);
        return std::string{std::istreambuf_iterator<char>(stream), {}};
    };
    EXPECT_NE(bytes_at(1.0F), bytes_at(2.0F));
    EXPECT_EQ(bytes_at(4.0F), bytes_at(8.0F));  // both white
}

TEST(runtime_png, folder_that_cannot_be_written_is_named) {
    const auto folder = fresh_folder("zonal_png_blocked");
    std::ofstream(folder / "file") << "not a folder";
    const std::string message = message_of_writing(folder / "file" / "a.png", {zonal::black_map(1)});
    EXPECT_NE(message.find("a.png: output: found a file that cannot be written"), std::string::npos)
        << message;
}

TEST(runtime_png, failed_rename_leaves_no_temporary) {
    const auto folder = fresh_folder("zonal_png_rename");
    std::filesystem::create_directories(folder / "a.png" /
                                        "inside");  // a folder that is not empty is not replaced
    EXPECT_NE(message_of_writing(folder / "a.png", {zonal::black_map(1)}), "no error");
    EXPECT_FALSE(std::filesystem::exists(folder / "a.png.part"));
}

TEST(runtime_png, unequal_heights_and_no_panels_are_refused) {
    const auto path = fresh_folder("zonal_png_panels_refused") / "a.png";
    EXPECT_NE(message_of_writing(path, {zonal::black_map(2), zonal::black_map(3)}).find("found 3, wanted 2"),
              std::string::npos);
    EXPECT_NE(message_of_writing(path, {}).find("nothing to draw"), std::string::npos);
    EXPECT_FALSE(std::filesystem::exists(path));
}

}  // namespace
