// GLSL as fragment shaders of OpenGL ES 3.00 whose default precision is mediump, which llvmpipe computes in
// 16 bits, against the pointwise oracle: the bounds that banners publish.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <random>

#include "gpu/es_context.hpp"
#include "gpu/published_bounds.hpp"
#include "gpu/shader_source.hpp"

namespace zonal::gpu {
namespace {

const EsContext& context() {
    static const EsContext the_context;
    return the_context;
}

/// Results of every vector, by a row of the picture each.
std::vector<float> drawn(int order, const ReferenceKernel& kernel, const Vectors& vectors, int channels) {
    const int size = kernel.output_size * (kernel.has_signal() ? channels : 1), pixels = (size + 3) / 4;
    std::vector<EsContext::Texture> textures;
    const auto add = [&](const char* name, const std::vector<float>& values) {
        if (!values.empty())
            textures.push_back(
                {name, static_cast<int>(values.size()) / vectors.count, vectors.count, values});
    };
    add("rotations", vectors.rotations);
    add("inputs", vectors.inputs);
    const std::vector<float> picture =
        context().draw(fragment_shader(order, kernel, channels), textures, pixels, vectors.count);
    std::vector<float> results;
    for (int k = 0; k < vectors.count; ++k) {
        const auto row = picture.begin() + std::ptrdiff_t{4} * pixels * k;
        results.insert(results.end(), row, row + size);
    }
    return results;
}

/// Random and hard rotations, tilts near the poles among them, and hard signals that 32 bits hold.
std::vector<accuracy::Problem> problems(int order) {
    auto all = accuracy::problems<float>(order, 100, 3000, 20240611u + static_cast<unsigned>(order));
    std::mt19937_64 random(20240611u + static_cast<unsigned>(order));
    std::uniform_real_distribution<double> angle(-4, 4);
    for (int k = 0; k < 20; ++k)
        all.push_back({"rotation about z", cases::about_axis({0, 0, 1}, angle(random)),
                       cases::random_signal(order, random)});
    const auto tilts = tiny_tilts(order);
    all.insert(all.end(), tilts.begin(), tilts.end());
    return all;
}

TEST(Es, mediump_is_computed_in_16_bits_here) {
    // 1 + 2^-12 is 1 in 16 bits. Without that, nothing below would tell whether a declaration is highp.
    const float input = 0x1p-12f;
    const EsContext::Texture texture{"inputs", 1, 1, {&input, 1}};
    const auto picture = context().draw(
        "#version 300 es\n"
        "precision mediump float;\n"
        "uniform highp sampler2D inputs;\n"
        "layout(location = 0) out highp vec4 results;\n"
        "void main() {\n"
        "    highp float high = texelFetch(inputs, ivec2(0), 0).r;\n"
        "    float medium = high;\n"
        "    float sum = medium + 1.0;\n"
        "    results = vec4(sum, high + 1.0, 0.0, 0.0);\n"
        "}\n",
        {&texture, 1}, 1, 1);
    EXPECT_EQ(picture[0], 1.0f) << context().name();
    EXPECT_EQ(picture[1], 1 + 0x1p-12f) << context().name();
}

class EsAccuracy : public testing::TestWithParam<int> {};

TEST_P(EsAccuracy, functions_are_within_the_published_bounds_where_mediump_is_the_default) {
    const int order = GetParam();
    const auto all = problems(order);
    for (const int channels : {1, 3}) {
        auto kernels = turning_kernels(order);
        if (channels == 3)
            std::erase_if(kernels, [](const ReferenceKernel& kernel) { return !kernel.has_signal(); });
        const auto run = [&](const ReferenceKernel& kernel, const Vectors& vectors) {
            return drawn(order, kernel, vectors, channels);
        };
        expect_within(worst_of_kernels(order, kernels, all, channels, run),
                      channels == 3 ? "GLSL ES vec3" : "GLSL ES", order);
    }
}

/// Those whose shaders are committed.
std::vector<int> orders() {
    std::vector<int> all = reference_orders();
    std::erase_if(all, [](int order) { return order < 3 || order > 6; });
    return all;
}

INSTANTIATE_TEST_SUITE_P(orders, EsAccuracy, testing::ValuesIn(orders()),
                         [](const auto& order) { return fmt::format("order_{}", order.param); });

}  // namespace
}  // namespace zonal::gpu
