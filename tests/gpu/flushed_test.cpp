// Tilts near the poles by modules and GLSL on a Vulkan device that flushes denormals, against the pointwise
// oracle: the bounds that banners publish. lavapipe keeps denormals and offers no choice, but its threads
// take over the floating-point state of the thread that makes them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <functional>
#include <optional>

#include "gpu/emitted_shaders.hpp"
#include "gpu/published_bounds.hpp"
#include "gpu/shader_source.hpp"
#include "support/flushed_denormals.hpp"

namespace zonal::gpu {
namespace {

/// From before main(), which makes the device, to the first test.
std::optional<FlushedDenormals> while_the_device_is_made(std::in_place);

float square_on_device(float value) {
    const ModuleRunner runner(compiled("#version 450\n"
                                       "layout(local_size_x_id = 0) in;\n"
                                       "layout(push_constant) uniform Push { uint count; };\n"
                                       "layout(std430, binding = 0) readonly buffer In { float a[]; };\n"
                                       "layout(std430, binding = 2) buffer Out { float o[]; };\n"
                                       "void main() {\n"
                                       "    uint i = gl_GlobalInvocationID.x;\n"
                                       "    if (i < count) o[i] = a[i] * a[i];\n"
                                       "}\n"),
                              1);
    Vectors vectors;
    vectors.count = 1;
    vectors.rotations = {value};
    return runner.run(vectors).front();
}

class Flushed : public testing::TestWithParam<int> {
  protected:
    static void SetUpTestSuite() { while_the_device_is_made.reset(); }
    /// Without that, nothing below would tell what is lost.
    void SetUp() override {
        if (!FlushedDenormals::kIsSupported) GTEST_SKIP() << "not known how to flush denormals here";
        ASSERT_EQ(square_on_device(1.08e-19f), 0.0f) << device_name() << " keeps denormals";
    }
    int order() const { return GetParam(); }
    void expect_tilts_within(const std::string& form, int channels,
                             const std::function<Words(const ReferenceKernel&)>& words) const {
        auto kernels = turning_kernels(order());
        // The others have no pole; `apply` takes what `prepare` made of R.
        std::erase_if(kernels, [&](const ReferenceKernel& kernel) {
            return !divides(order(), kernel) || (channels == 3 && !kernel.has_signal());
        });
        ASSERT_FALSE(kernels.empty());
        const auto run = [&](const ReferenceKernel& kernel, const Vectors& vectors) {
            return ModuleRunner(words(kernel), channels * kernel.output_size).run(vectors);
        };
        expect_within(worst_of_kernels(order(), kernels, tiny_tilts(order()), channels, run), form, order());
    }
    Words module(const ReferenceKernel& kernel, const char* ending) const {
        return assembled(read_text(spirv_folder() /
                                   fmt::format("{}/{}{}.spvasm", order_stem(order()), kernel.name, ending)));
    }
};

TEST_P(Flushed, tiny_tilts_by_modules_are_within_the_published_bounds) {
    expect_tilts_within("module", 1, [this](const auto& kernel) { return module(kernel, ""); });
    expect_tilts_within("module of three channels", 3,
                        [this](const auto& kernel) { return module(kernel, "_rgb"); });
}

TEST_P(Flushed, tiny_tilts_by_glsl_are_within_the_published_bounds) {
    for (const int channels : {1, 3})
        expect_tilts_within(channels == 3 ? "GLSL vec3" : "GLSL", channels, [&](const auto& kernel) {
            return compiled(compute_shader(order(), kernel, channels));
        });
}

/// Those that divide; longer shaders take lavapipe minutes.
std::vector<int> orders() {
    std::vector<int> all = reference_orders();
    std::erase_if(all, [](int order) { return order < 4 || order > 6; });
    return all;
}

INSTANTIATE_TEST_SUITE_P(orders, Flushed, testing::ValuesIn(orders()),
                         [](const auto& order) { return fmt::format("order_{}", order.param); });

}  // namespace
}  // namespace zonal::gpu
