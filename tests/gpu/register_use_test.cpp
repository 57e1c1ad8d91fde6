// What a compiler for GPUs makes of the committed SPIR-V, and of signal-tailored rotation in GLSL: nothing
// spills, and few registers are held. The null device of Mesa's RADV says so; its numbers are the same on
// every run and change with Mesa's version.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <filesystem>
#include <map>

#include "gpu/emitted_shaders.hpp"
#include "gpu/pipeline_statistics.hpp"
#include "gpu/shader_modules.hpp"
#include "gpu/tailored_shader.hpp"

namespace {

namespace fs = std::filesystem;
using zonal::gpu::Device;
using zonal::gpu::PipelineStatistics;

/// What signal-tailored rotation holds, the more of both families, by order: all coordinates and the whole
/// output wait at one time.
const std::map<int, unsigned> kTailoredRegisters{{3, 48}, {4, 84}, {5, 112}, {6, 164}};

std::string tailored(int order) { return fmt::format("order{:02}_tailored_rgb", order); }

/// Statistics of every compute module of orders 3 to 6, by its name (order04_rotate_rgb), and of the tailored
/// rotations.
std::map<std::string, PipelineStatistics> statistics_of_all(const std::string& family) {
    const Device device({.radv_family = family, .wants_executable_properties = true});
    std::map<std::string, PipelineStatistics> all;
    for (int order = 3; order <= 6; ++order) {
        const std::string stem = zonal::gpu::order_stem(order);
        for (const fs::directory_entry& entry : fs::directory_iterator(zonal::gpu::spirv_folder() / stem))
            all[fmt::format("{}_{}", stem, entry.path().stem().string())] =
                statistics_of(device, zonal::gpu::read_shader(entry.path()));
    }
    for (const auto& [order, registers] : kTailoredRegisters)
        all[tailored(order)] = statistics_of(device, zonal::gpu::compiled(zonal::gpu::tailored_compute_shader(
                                                         order, zonal::gpu::tailored_text(order))));
    return all;
}

class RegisterUse : public testing::TestWithParam<const char*> {
  protected:
    static const std::map<std::string, PipelineStatistics>& all() {
        static std::map<std::string, std::map<std::string, PipelineStatistics>> by_family;
        auto [known, is_new] = by_family.try_emplace(GetParam());
        if (is_new) known->second = statistics_of_all(GetParam());
        return known->second;
    }

    /// Of the order's modules for one channel, those whose arithmetic may be contracted.
    static void expect_registers_at_most(unsigned limit, int order) {
        const std::string stem = fmt::format("order{:02}_", order);
        ASSERT_TRUE(all().contains(stem + "rotate"));
        for (const auto& [name, statistics] : all()) {
            if (!name.starts_with(stem) || name.ends_with("_rgb") || name.ends_with("_precise")) continue;
            EXPECT_LE(statistics.vgprs, limit) << name;
        }
    }
};

TEST_P(RegisterUse, no_kernel_up_to_order_6_spills) {
    ASSERT_GE(all().size(), 200u) << "of four orders; found fewer in " << zonal::gpu::spirv_folder();
    for (const auto& [name, statistics] : all()) {
        EXPECT_EQ(statistics.spilled_vgprs, 0u) << name;
        EXPECT_EQ(statistics.spilled_sgprs, 0u) << name;
    }
}

TEST_P(RegisterUse, a_scalar_signal_of_order_4_holds_64_registers_at_most) {
    expect_registers_at_most(64, 4);
}

TEST_P(RegisterUse, a_scalar_signal_of_order_6_holds_128_registers_at_most) {
    expect_registers_at_most(128, 6);
}

TEST_P(RegisterUse, a_tailored_rotation_holds_no_more_than_it_did) {
    for (const auto& [order, registers] : kTailoredRegisters)
        EXPECT_LE(all().at(tailored(order)).vgprs, registers) << tailored(order);
}

INSTANTIATE_TEST_SUITE_P(Families, RegisterUse, testing::Values("navi21", "vega10"),
                         [](const auto& family) { return std::string(family.param); });

}  // namespace
