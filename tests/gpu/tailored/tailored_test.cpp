// Signal-tailored rotation as a shader does it, on the Vulkan device, within the bound of its tables.
#include <fmt/format.h>
#include <glslang/Public/ResourceLimits.h>
#include <glslang/Public/ShaderLang.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "gpu/compute.hpp"
#include "gpu/emitted_shaders.hpp"
#include "gpu/shader_modules.hpp"
#include "gpu/tailored/cube_map_array.hpp"
#include "gpu/tailored_shader.hpp"
#include "support/oracle.hpp"
#include "zonal/signal_tables.hpp"

namespace {

using Eigen::half;
using zonal::Rgb;
using zonal::SignalTablePlan;
using zonal::SignalTables;
using Matrix = Eigen::Matrix<float, 3, 3, Eigen::RowMajor>;
using Signal = std::vector<Rgb<float>>;

/// Weaker towards high bands, as lighting is.
Signal lighting(int order) {
    std::mt19937 random(static_cast<unsigned>(order));
    std::normal_distribution<float> normal;
    Signal signal(order * order);
    for (int l = 0; l < order; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            signal[i] = (1.0f / static_cast<float>(l + 1)) *
                        Rgb<float>{normal(random), normal(random), normal(random)};
    return signal;
}

/// The 48 that permute and mirror the axes, and random ones.
std::vector<Matrix> rotations() {
    std::vector<Matrix> result;
    std::array<int, 3> axes{0, 1, 2};
    do {
        for (int signs = 0; signs < 8; ++signs) {
            Matrix matrix = Matrix::Zero();
            for (int i = 0; i < 3; ++i) matrix(i, axes[i]) = (signs >> i & 1) != 0 ? -1.0f : 1.0f;
            result.push_back(matrix);
        }
    } while (std::next_permutation(axes.begin(), axes.end()));
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    for (int k = 0; k < 150; ++k) {
        const Eigen::Quaternionf q(normal(random), normal(random), normal(random), normal(random));
        result.push_back(q.normalized().toRotationMatrix());
    }
    return result;
}

/// A shader and the floats that it reads and writes for each invocation.
struct Work {
    int input_size = 0, output_size = 0;
    std::string shader;
};

Work rotate_tailored(int order) {
    return {9, 3 * order * order,
            zonal::gpu::tailored_compute_shader(order, zonal::gpu::tailored_text(order))};
}

/// The first layer's value in a direction.
Work look_up(int order) {
    return {3, 3,
            "#version 450\n" + zonal::gpu::tailored_text(order) +
                fmt::format(R"(
layout(local_size_x_id = 0) in;
layout(push_constant) uniform Push {{ uint count; }};
layout(set = 0, binding = 0, std430) readonly buffer Inputs {{ float inputs[]; }};
layout(set = 0, binding = 2, std430) writeonly buffer Results {{ float results[]; }};
layout(set = 0, binding = 3) uniform samplerCubeArray bands;
layout(set = 0, binding = 4, std430) readonly buffer Levels {{ float levels[]; }};
void main() {{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    vec3 w = zonal_order{}_face_direction(vec3(inputs[3 * i], inputs[3 * i + 1], inputs[3 * i + 2]));
    vec3 value = textureLod(bands, vec4(w, 0.0), levels[0]).rgb;
    for (int c = 0; c < 3; ++c) results[3 * i + c] = value[c];
}}
)",
                            order)};
}

double norm(const Signal& signal) {
    double sum = 0;
    for (const auto& [r, g, b] : signal) sum += 1.0 * r * r + 1.0 * g * g + 1.0 * b * b;
    return std::sqrt(sum);
}

std::vector<zonal::oracle::Real> channel(const Signal& signal, int c) {
    std::vector<zonal::oracle::Real> result;
    for (const auto& [r, g, b] : signal) result.push_back(std::array{r, g, b}[c]);
    return result;
}

zonal::oracle::Matrix3 oracle_matrix(const Matrix& matrix) {
    zonal::oracle::Matrix3 result;
    std::copy_n(matrix.data(), 9, result.begin());
    return result;
}

class Tailored : public testing::TestWithParam<int> {
  protected:
    static void SetUpTestSuite() { device_ = std::make_unique<zonal::gpu::Device>(); }
    static void TearDownTestSuite() { device_.reset(); }

    static int subtexel_bits() {
        return static_cast<int>(device_->physical().getProperties().limits.subTexelPrecisionBits);
    }

    /// Results of all inputs.
    template <class T>
    static std::vector<float> run(const Work& work, const SignalTables<T>& tables, const Signal& signal,
                                  const std::vector<float>& inputs) {
        const SignalTablePlan& plan = tables.plan;
        const zonal::gpu::CubeMapArray bands(
            *device_,
            {sizeof(T) == 4 ? vk::Format::eR32G32B32A32Sfloat : vk::Format::eR16G16B16A16Sfloat,
             static_cast<std::uint32_t>(plan.face_size), static_cast<std::uint32_t>(plan.level_count),
             static_cast<std::uint32_t>(plan.layer_count()), 4 * sizeof(T)},
            std::as_bytes(std::span(tables.texels)));
        const std::size_t count = inputs.size() / work.input_size;
        std::vector<float> low;
        for (std::size_t k = 0; k < count; ++k)
            for (int i = 0; i < 4; ++i) low.insert(low.end(), {signal[i].r, signal[i].g, signal[i].b});
        const zonal::gpu::Buffer in(*device_, inputs), low_bands(*device_, low),
            levels(*device_, std::vector<float>(plan.levels.begin(), plan.levels.end())),
            out(*device_, work.output_size * count);
        const zonal::gpu::ComputePipeline pipeline(*device_, zonal::gpu::compiled(work.shader),
                                                   {.storage_buffers = {0, 1, 2, 4}, .sampled_images = {3}});
        const std::vector<zonal::gpu::Binding> bindings{
            {0, &in}, {1, &low_bands}, {2, &out}, {3, bands.sampled()}, {4, &levels}};
        pipeline.dispatch(bindings, static_cast<std::uint32_t>(count));
        return {out.values().begin(), out.values().end()};
    }

    template <class T>
    static void check_rotations(double budget) {
        const int order = GetParam();
        const Signal signal = lighting(order);
        const auto tables = zonal::build_signal_tables<T>(
            order, signal, {.budget = budget, .subtexel_bits = subtexel_bits()});
        const std::vector<Matrix> turns = rotations();
        std::vector<float> matrices;
        for (const Matrix& turn : turns) matrices.insert(matrices.end(), turn.data(), turn.data() + 9);
        const std::vector<float> results = run(rotate_tailored(order), tables, signal, matrices);
        const zonal::oracle::Rotation exact(order);
        double largest = 0;
        for (std::size_t k = 0; k < turns.size(); ++k) {
            const zonal::oracle::Matrix3 matrix = oracle_matrix(turns[k]);
            double sum = 0;
            for (int c = 0; c < 3; ++c) {
                const auto expected = exact(matrix, channel(signal, c));
                for (std::size_t i = 0; i < expected.size(); ++i)
                    sum += std::pow(
                        static_cast<double>(results[3 * (signal.size() * k + i) + c] - expected[i]), 2);
            }
            const double error = std::sqrt(sum) / norm(signal);
            const double excess =
                tables.plan.excess * static_cast<double>(zonal::oracle::orthonormality_error(matrix));
            EXPECT_LE(error, tables.plan.bound + excess) << "order " << order << ", rotation\n" << turns[k];
            largest = std::max(largest, error);
        }
        // The bound adds what bands lose at worst; in a rotation some of it cancels.
        EXPECT_GT(largest, tables.plan.bound / (5 * order)) << "the bound says nothing";
        // A row of the table in tests/bench/README.md.
        fmt::print("| {} | {:g} | {} | {}: {} | {:.2g} | {:.1e} | {:.1e} |\n", order, budget,
                   sizeof(T) == 4 ? "32F" : "16F", tables.plan.face_size, fmt::join(tables.plan.levels, " "),
                   static_cast<double>(tables.byte_count()) / 1e6, tables.plan.bound, largest);
    }

  private:
    static inline std::unique_ptr<zonal::gpu::Device> device_;
};

TEST_P(Tailored, rotation_with_float_texels_is_within_its_bound) {
    for (const double budget : {0.01, 0.002}) check_rotations<float>(budget);
}
TEST_P(Tailored, rotation_with_half_texels_is_within_its_bound) {
    for (const double budget : {0.05, 0.02}) check_rotations<half>(budget);
}

TEST_P(Tailored, edges_and_corners_of_the_cube_have_the_value_of_their_band) {
    const int order = GetParam();
    Signal signal = lighting(order);
    std::fill(signal.begin() + 9, signal.end(), Rgb<float>{});
    const auto tables =
        zonal::build_signal_tables<float>(order, signal, {.budget = 3e-4, .subtexel_bits = subtexel_bits()});
    ASSERT_GT(tables.plan.face_size, 2 * zonal::kSmallestFace) << "wanted faces that reach beyond edges";
    std::vector<float> directions;
    for (const float x : {-1.0f, 0.0f, 0.3f, 1.0f})
        for (const float y : {-1.0f, 0.0f, 0.3f, 1.0f})
            for (const float z : {-1.0f, 0.0f, 0.3f, 1.0f})
                if (std::max({std::abs(x), std::abs(y), std::abs(z)}) == 1)
                    directions.insert(directions.end(), {x, y, z});
    const std::vector<float> results = run(look_up(order), tables, signal, directions);
    // The bound of band 2 is that of a sample times at least 1.
    const double bound = tables.plan.band_bounds[0] * norm(signal);
    std::fill(signal.begin(), signal.begin() + 4, Rgb<float>{});
    for (std::size_t k = 0; k < directions.size() / 3; ++k) {
        const Eigen::Vector3d w =
            Eigen::Vector3f(directions[3 * k], directions[3 * k + 1], directions[3 * k + 2])
                .cast<double>()
                .normalized();
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(results[3 * k + c],
                        static_cast<double>(
                            zonal::oracle::evaluate(order, channel(signal, c), {w.x(), w.y(), w.z()})),
                        bound)
                << "at " << w.transpose();
    }
}

TEST_P(Tailored, compiles_as_a_fragment_shader_of_es_3_20) {
    const int order = GetParam();
    const std::string text =
        fmt::format(R"(#version 320 es
precision highp float;
{functions}
uniform float R[9];
uniform vec3 low[4];
uniform float levels[{layers}];
uniform highp samplerCubeArray bands;
out vec4 color;
void main() {{
    vec3 o[{size}];
    zonal_order{order}_rotate_tailored(R, low, bands, levels, o);
    color = vec4(o[{size} - 1], 1.0);
}}
)",
                    fmt::arg("functions", zonal::gpu::tailored_text(order)), fmt::arg("order", order),
                    fmt::arg("size", order * order), fmt::arg("layers", order - zonal::kFirstTableBand));
    glslang::InitializeProcess();
    {
        glslang::TShader shader(EShLangFragment);
        const char* lines = text.c_str();
        shader.setStrings(&lines, 1);
        EXPECT_TRUE(shader.parse(GetDefaultResources(), 320, EEsProfile, false, false, EShMsgDefault))
            << shader.getInfoLog();
    }
    glslang::FinalizeProcess();
}

INSTANTIATE_TEST_SUITE_P(orders, Tailored, testing::Values(3, 4, 5, 6),
                         [](const auto& order) { return fmt::format("order_{}", order.param); });

}  // namespace
