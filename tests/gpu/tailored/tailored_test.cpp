// Signal-tailored rotation as a shader does it, on the Vulkan device, within the bound of its tables.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <memory>
#include <random>
#include <vector>

#include "gpu/compute.hpp"
#include "gpu/modules.hpp"
#include "gpu/tailored/cube_map_array.hpp"
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

/// A compute shader that turns the signal by rotation after rotation.
std::string shader_text(int order) {
    const auto function = [&](const char* suffix) {
        return zonal::gpu::read_text(zonal::gpu::glsl_folder() /
                                     (zonal::gpu::order_stem(order) + suffix + ".glsl"));
    };
    return "#version 450\n" + function("") + function("_tailored") +
           fmt::format(R"(
layout(local_size_x_id = 0) in;
layout(push_constant) uniform Push {{ uint count; }};
layout(set = 0, binding = 0, std430) readonly buffer Rotations {{ float rotations[]; }};
layout(set = 0, binding = 1, std430) readonly buffer Low {{ float low_and_levels[]; }};
layout(set = 0, binding = 2, std430) writeonly buffer Out {{ float results[]; }};
layout(set = 0, binding = 3) uniform samplerCubeArray bands;
void main() {{
    uint i = gl_GlobalInvocationID.x;
    if (i >= count) return;
    float R[9];
    for (int k = 0; k < 9; ++k) R[k] = rotations[9 * i + k];
    vec3 low[4];
    for (int k = 0; k < 4; ++k)
        low[k] = vec3(low_and_levels[3 * k], low_and_levels[3 * k + 1], low_and_levels[3 * k + 2]);
    float levels[{layers}];
    for (int k = 0; k < {layers}; ++k) levels[k] = low_and_levels[12 + k];
    vec3 o[{size}];
    zonal_order{order}_rotate_tailored(R, low, bands, levels, o);
    for (int k = 0; k < {size}; ++k)
        for (int c = 0; c < 3; ++c) results[3 * ({size} * i + k) + c] = o[k][c];
}}
)",
                       fmt::arg("order", order), fmt::arg("size", order * order),
                       fmt::arg("layers", order - zonal::kFirstTableBand));
}

class Tailored : public testing::TestWithParam<int> {
  protected:
    static void SetUpTestSuite() { device_ = std::make_unique<zonal::gpu::Device>(); }
    static void TearDownTestSuite() { device_.reset(); }
    static const zonal::gpu::Device& device() { return *device_; }

    static int subtexel_bits() {
        return static_cast<int>(device().physical().getProperties().limits.subTexelPrecisionBits);
    }

    template <class T>
    static std::vector<float> run(const SignalTables<T>& tables, const Signal& signal,
                                  const std::vector<Matrix>& rotations) {
        const SignalTablePlan& plan = tables.plan;
        const zonal::gpu::CubeMapArray bands(
            device(),
            {sizeof(T) == 4 ? vk::Format::eR32G32B32A32Sfloat : vk::Format::eR16G16B16A16Sfloat,
             static_cast<std::uint32_t>(plan.face_size), static_cast<std::uint32_t>(plan.level_count),
             static_cast<std::uint32_t>(plan.layer_count()), 4 * sizeof(T)},
            std::as_bytes(std::span(tables.texels)));
        std::vector<float> matrices, low_and_levels;
        for (const Matrix& matrix : rotations)
            matrices.insert(matrices.end(), matrix.data(), matrix.data() + 9);
        for (int i = 0; i < 4; ++i)
            for (const float value : {signal[i].r, signal[i].g, signal[i].b}) low_and_levels.push_back(value);
        for (const int level : plan.levels) low_and_levels.push_back(static_cast<float>(level));
        const zonal::gpu::Buffer input(device(), matrices), constants(device(), low_and_levels),
            output(device(), 3 * signal.size() * rotations.size());
        const zonal::gpu::ComputePipeline pipeline(device(), zonal::gpu::compiled(shader_text(plan.order)),
                                                   {.sampled_images = {3}});
        const std::vector<zonal::gpu::Binding> bindings{
            {0, &input}, {1, &constants}, {2, &output}, {3, bands.sampled()}};
        pipeline.dispatch(bindings, static_cast<std::uint32_t>(rotations.size()));
        return {output.values().begin(), output.values().end()};
    }

    template <class T>
    static void check(double budget) {
        const int order = GetParam();
        const Signal signal = lighting(order);
        const auto tables = zonal::build_signal_tables<T>(
            order, signal, {.budget = budget, .subtexel_bits = subtexel_bits()});
        const std::vector<Matrix> turns = rotations();
        const std::vector<float> results = run(tables, signal, turns);
        const zonal::oracle::Rotation exact(order);
        double scale = 0, largest = 0;
        for (const auto& [r, g, b] : signal) scale += 1.0 * r * r + 1.0 * g * g + 1.0 * b * b;
        for (std::size_t k = 0; k < turns.size(); ++k) {
            zonal::oracle::Matrix3 matrix;
            std::copy_n(turns[k].data(), 9, matrix.begin());
            double sum = 0;
            for (int c = 0; c < 3; ++c) {
                std::vector<zonal::oracle::Real> channel;
                for (const auto& [r, g, b] : signal) channel.push_back(std::array{r, g, b}[c]);
                const auto expected = exact(matrix, channel);
                for (std::size_t i = 0; i < expected.size(); ++i)
                    sum += std::pow(
                        static_cast<double>(results[3 * (signal.size() * k + i) + c] - expected[i]), 2);
            }
            const double error = std::sqrt(sum / scale);
            const double excess =
                tables.plan.excess * static_cast<double>(zonal::oracle::orthonormality_error(matrix));
            EXPECT_LE(error, tables.plan.bound + excess) << "order " << order << ", rotation\n" << turns[k];
            largest = std::max(largest, error);
        }
        const auto name = fmt::format("{}_bits", 8 * sizeof(T));
        RecordProperty(name,
                       fmt::format("face {}, {} bytes, bound {:.2e}, measured {:.2e}", tables.plan.face_size,
                                   tables.byte_count(), tables.plan.bound, largest));
        fmt::print("order {}, {}: face {}, levels {}, {:.3g} MB, bound {:.2e}, measured {:.2e}\n", order,
                   name, tables.plan.face_size, fmt::join(tables.plan.levels, " "),
                   static_cast<double>(tables.byte_count()) / 1e6, tables.plan.bound, largest);
    }

  private:
    static inline std::unique_ptr<zonal::gpu::Device> device_;
};

TEST_P(Tailored, rotation_with_float_texels_is_within_its_bound) { check<float>(0.005); }
TEST_P(Tailored, rotation_with_half_texels_is_within_its_bound) { check<half>(0.05); }

INSTANTIATE_TEST_SUITE_P(orders, Tailored, testing::Values(3, 4, 5, 6),
                         [](const auto& info) { return fmt::format("order_{}", info.param); });

}  // namespace
