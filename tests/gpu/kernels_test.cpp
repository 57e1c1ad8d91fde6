// Every emitted kernel on the Vulkan device beside the generated C++ kernel that was compiled without fused
// instructions: random and hard rotations, hard signals, NaN, vectors in place, a last workgroup not full.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <set>
#include <span>

#include "gpu/emitted_shaders.hpp"
#include "gpu/passed_record.hpp"
#include "gpu/shader_source.hpp"
#include "gpu/vectors.hpp"
#include "support/banner.hpp"

namespace zonal::gpu {
namespace {

class Kernels : public testing::TestWithParam<int> {
  protected:
    int order() const { return GetParam(); }
    Words module(const std::string& name) const {
        return assembled(read_text(spirv_folder() / fmt::format("{}/{}.spvasm", order_stem(order()), name)));
    }
    void expect_within_bounds(const std::string& form, const ReferenceKernel& kernel, const Words& words,
                              int channels) const {
        const Vectors vectors = test_vectors(order(), kernel, channels);
        const std::vector<float> wanted = expected_results(kernel, vectors, channels);
        const std::string name = fmt::format("order {:02}, {}, {}", order(), form, kernel.name);
        const std::string fingerprint = fingerprint_of(kernel, words, vectors, wanted, channels);
        if (is_recorded(form) && has_passed(name, fingerprint)) return;
        const ModuleRunner runner(words, channels * kernel.output_size);
        const std::vector<float> got = runner.run(vectors);
        const std::string difference = distance(order(), kernel, vectors, got, wanted, channels);
        EXPECT_EQ(difference, "") << name;
        if (is_recorded(form) && difference.empty() && !HasFailure()) record_pass(name, fingerprint);
    }

  private:
    /// lavapipe compiles them for minutes: see CMakeLists.txt, which has them run apart.
    bool is_recorded(const std::string& form) const { return order() >= 7 && form != "plain"; }
    /// Of all that decides whether the module passes.
    std::string fingerprint_of(const ReferenceKernel& kernel, const Words& words, const Vectors& vectors,
                               const std::vector<float>& wanted, int channels) const {
        static const std::string sources = judging_sources();
        Fingerprint fingerprint;
        fingerprint.add(device_name());
        fingerprint.add(sources);
        fingerprint.add(std::span<const std::uint32_t>(words));
        for (const auto* values : {&vectors.rotations, &vectors.inputs, &vectors.matrices, &wanted})
            fingerprint.add(std::span<const float>(*values));
        const std::string bound = bound_name(order(), kernel, channels);
        if (kernel.makes_turns()) {
            const banner::Bound published = banner::bound(order(), bound);
            fingerprint.add(
                fmt::format("{} {} {}", published.float_bound, published.excess, published.takes_mirrors));
        }
        return fingerprint.text();
    }
};

TEST_P(Kernels, are_those_of_cpp) {
    std::set<std::string> modules, functions;
    for (const ReferenceKernel& kernel : reference_kernels(order())) {
        functions.insert(kernel.name + ".glsl");
        for (const char* form : {"", "_precise"}) modules.insert(kernel.name + form + ".spvasm");
        if (kernel.has_signal()) modules.insert(kernel.name + "_rgb.spvasm");
    }
    const auto files = [&](const std::filesystem::path& folder) {
        std::set<std::string> names;
        for (const auto& entry : std::filesystem::directory_iterator(folder / order_stem(order())))
            names.insert(entry.path().filename().string());
        return names;
    };
    EXPECT_EQ(files(spirv_folder()), modules);
    if (functions.contains("resample.glsl")) functions.insert("rotate_tailored.glsl");
    EXPECT_EQ(files(glsl_folder()), functions);
}

TEST_P(Kernels, precise_modules_give_the_bits_of_cpp) {
    for (const ReferenceKernel& kernel : reference_kernels(order())) {
        const ModuleRunner runner(module(kernel.name + "_precise"), kernel.output_size);
        const Vectors vectors = test_vectors(order(), kernel, 1);
        ASSERT_NE(vectors.count % 64, 0);
        const std::vector<float> expected = expected_results(kernel, vectors, 1);
        EXPECT_EQ(difference(runner.run(vectors), expected, kernel.output_size), "") << kernel.name;
        if (kernel.input_size != kernel.output_size) continue;
        EXPECT_EQ(difference(runner.run_in_place(vectors), expected, kernel.output_size), "")
            << kernel.name << " in place";
    }
}

TEST_P(Kernels, plain_and_rgb_modules_turn_in_place) {
    const ReferenceKernel& kernel = reference_kernel(order(), "rotate");
    for (const int channels : {1, 3}) {
        const Vectors vectors = test_vectors(order(), kernel, channels);
        const ModuleRunner runner(module(channels == 3 ? "rotate_rgb" : "rotate"),
                                  channels * kernel.output_size);
        const int size = channels * kernel.output_size;
        EXPECT_EQ(difference(runner.run_in_place(vectors), runner.run(vectors), size), "") << channels;
    }
}

TEST_P(Kernels, the_workgroup_takes_its_size_from_the_specialization) {
    const ReferenceKernel& kernel = reference_kernel(order(), "rotate");
    const Vectors vectors = test_vectors(order(), kernel, 1);
    // A module of fixed size 64 would leave every second 64 of 128 vectors untouched.
    const ModuleRunner usual(module("rotate"), kernel.output_size);
    for (const int size : {16, 128}) {
        const ModuleRunner runner(module("rotate"), kernel.output_size, size);
        EXPECT_EQ(difference(runner.run(vectors), usual.run(vectors), kernel.output_size), "") << size;
    }
}

TEST_P(Kernels, plain_modules_are_within_bounds_of_cpp) {
    for (const ReferenceKernel& kernel : reference_kernels(order()))
        if (!kernel.makes_turns()) expect_within_bounds("plain", kernel, module(kernel.name), 1);
}

TEST_P(Kernels, modules_of_three_channels_are_within_bounds_of_cpp) {
    for (const ReferenceKernel& kernel : reference_kernels(order()))
        if (kernel.has_signal()) expect_within_bounds("rgb", kernel, module(kernel.name + "_rgb"), 3);
}

TEST_P(Kernels, glsl_functions_are_within_bounds_of_cpp) {
    EXPECT_NO_THROW(compiled(shader_of_all_files(order())));
    for (const ReferenceKernel& kernel : reference_kernels(order()))
        expect_within_bounds("GLSL", kernel, compiled(compute_shader(order(), kernel, 1)), 1);
}

TEST_P(Kernels, glsl_functions_on_vec3_are_within_bounds_of_cpp) {
    for (const ReferenceKernel& kernel : reference_kernels(order()))
        if (kernel.has_signal())
            expect_within_bounds("GLSL vec3", kernel, compiled(compute_shader(order(), kernel, 3)), 3);
}

/// HLSL is committed for these.
class HlslKernels : public Kernels {};

TEST_P(HlslKernels, functions_are_within_bounds_of_cpp) {
    EXPECT_NO_THROW(compiled(shader_of_all_files(order(), ShaderLanguage::hlsl), ShaderLanguage::hlsl));
    for (const ReferenceKernel& kernel : reference_kernels(order()))
        for (const int channels : {1, 3})
            if (channels == 1 || kernel.has_signal())
                expect_within_bounds(fmt::format("HLSL, {} channels", channels), kernel,
                                     compiled(compute_shader(order(), kernel, channels, ShaderLanguage::hlsl),
                                              ShaderLanguage::hlsl),
                                     channels);
}

INSTANTIATE_TEST_SUITE_P(orders, HlslKernels, testing::Values(3, 4, 5, 6),
                         [](const auto& order) { return fmt::format("order_{}", order.param); });

INSTANTIATE_TEST_SUITE_P(orders, Kernels, testing::ValuesIn(reference_orders()),
                         [](const auto& order) { return fmt::format("order_{}", order.param); });

}  // namespace
}  // namespace zonal::gpu
