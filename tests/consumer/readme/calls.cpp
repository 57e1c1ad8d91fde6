// Every call of README's table, by lobes along an axis.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <vector>

#include "splats.hpp"
#include "zonal/closed_forms.hpp"
#include "zonal/order03/rotate.hpp"
#include "zonal/order04/rotate.hpp"
#include "zonal/projection.hpp"
#include "zonal/rotate.hpp"

namespace {

int wrong = 0;

void expect(const char* what, float found, float wanted) {
    if (std::abs(found - wanted) < 1e-5F) return;
    std::printf("%s: found %g, wanted %g\n", what, found, wanted);
    wrong = 1;
}

constexpr int kY = 1, kX = 3;
constexpr float kRoot = 0.70710678F;  // sine and cosine of 45 degrees

const zonal::RotationMatrix<float> x_to_y(0, -1, 0, 1, 0, 0, 0, 0, 1);

void rotate_a_probe() {
    const auto& R = x_to_y;
    std::array<zonal::Rgb<float>, 16> probe{};
    probe[kX] = {1, 2, 3};
    zonal::rotate(4, R, probe, probe);
    expect("probe", probe[kY].b, 3);
}

void rotate_a_batch() {
    const auto& R = x_to_y;
    const zonal::BatchLayout layout = {.count = 3};
    std::vector<float> in(3 * 16), out(3 * 16);
    in[2 * 16 + kX] = 1;
    zonal::rotate_all(4, R, layout, in, out);
    expect("batch", out[2 * 16 + kY], 1);
}

void rotate_a_block_of_frames() {
    const auto& R = x_to_y;
    const zonal::PlanarLayout layout = {.count = 512};
    std::vector<float> buffers(16 * 512);
    std::vector<float*> pointers;
    for (int i = 0; i < 16; ++i) pointers.push_back(buffers.data() + 512 * i);
    const std::vector<const float*> read_pointers(pointers.begin(), pointers.end());
    const zonal::Planes<const float> planes_in(read_pointers);
    const zonal::Planes<float> planes_out(std::span(pointers.data(), 16));
    buffers[512 * kX + 100] = 1;
    zonal::rotate_all(4, R, layout, planes_in, planes_out);
    expect("frames", buffers[512 * kY + 100], 1);
}

void rotate_a_scene_of_splats() {
    // 90 degrees about y, z becomes x; coefficients of the green channel from index 15 on: y, z, x of signs
    // -, +, -.
    const float w = kRoot, x = 0, y = kRoot, z = 0;
    std::vector<float> f_rest(2 * 45);
    f_rest[45 + 15 + 1] = 1;
    rotate_splats(f_rest, w, x, y, z);
    expect("splats", f_rest[45 + 15 + 2], -1);
}

void rotate_a_sound_field() {
    // The head looks to the left, to where y was: what was ahead is at its right.
    const float w = kRoot, x = 0, y = 0, z = kRoot;
    const auto head_inverse = zonal::RotationMatrix<float>::from_quaternion_wxyz(w, -x, -y, -z);
    std::vector<float> in(16), out(16);
    in[kX] = 1;
    zonal::rotate(zonal::Convention::kAmbixSn3d, 4, head_inverse, in, out);
    expect("ambisonics", out[kY], -1);
}

void rotate_in_another_convention() {
    const auto& R = x_to_y;
    const auto convention = zonal::convention_from_name("unity_l2");
    const int order = 3;
    std::vector<float> in(9), out(9);
    in[kX] = 1;
    zonal::rotate(convention, order, R, in, out);
    expect("convention", out[kY], 1);
}

void rotate_by_kernels_alone() {
    const float R[9] = {0, -1, 0, 1, 0, 0, 0, 0, 1};
    float f[16] = {}, out[16];
    f[kX] = 1;
    zonal::order3::rotate(R, f, out);
    expect("order 3", out[kY], 1);
    zonal::order4::rotate(R, f, out);
    expect("order 4", out[kY], 1);
    if (zonal::order4::kRotateBoundFloat > 1e-6) wrong = 1;
}

void rotate_by_a_quaternion() {
    struct {
        float x, y, z, w;
    } q = {0, 0, kRoot, kRoot};
    const auto R = zonal::RotationMatrix<float>::from_quaternion_xyzw(q.x, q.y, q.z, q.w);
    expect("quaternion", R(1, 0), 1);
}

void project_a_map(const std::filesystem::path& map) {
    std::filesystem::copy_file(map, "sky.hdr", std::filesystem::copy_options::overwrite_existing);
    auto coefficients = zonal::project(4, zonal::read_environment_map("sky.hdr"));
    const double mean = coefficients[0].r;
    zonal::irradiance(4, coefficients, coefficients);
    expect("irradiance", static_cast<float>(coefficients[0].r / mean), 3.1415927F);
}

}  // namespace

int main(int, char** arguments) {
    rotate_a_probe();
    rotate_a_batch();
    rotate_a_block_of_frames();
    rotate_a_scene_of_splats();
    rotate_a_sound_field();
    rotate_in_another_convention();
    rotate_by_kernels_alone();
    rotate_by_a_quaternion();
    project_a_map(arguments[1]);
    return wrong;
}
