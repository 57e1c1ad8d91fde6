#include "gpu/vectors.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <limits>
#include <map>

#include "support/hard_cases.hpp"

namespace zonal::gpu {

namespace {

constexpr int kOfEachKind = 3, kRandom = 40;

std::vector<cases::Matrix> rotations(std::mt19937_64& random) {
    std::vector<cases::Matrix> all;
    std::map<std::string, int> seen;
    for (const cases::Case& hard : cases::hard_rotations<float>(random))
        if (seen[hard.name]++ < kOfEachKind) all.push_back(hard.rotation);
    for (int k = 0; k < kRandom; ++k) all.push_back(cases::random_rotation(random));
    return all;
}

/// Signals of `size` values: the hard ones where the kernel takes an SH vector, random ones, and for each
/// band one with a NaN.
std::vector<double> signal(int order, int size, std::size_t number, std::mt19937_64& random) {
    std::normal_distribution<double> normal;
    std::vector<double> f(size);
    for (double& value : f) value = normal(random);
    if (size != order * order) return f;
    const auto hard = cases::hard_signals(order, random);
    if (number < hard.size()) return hard[number];
    if (number < hard.size() + order) {
        const auto band = static_cast<int>(number - hard.size());
        f[band * band + band / 2] = std::numeric_limits<double>::quiet_NaN();
    }
    return f;
}

}  // namespace

Vectors test_vectors(int order, const ReferenceKernel& kernel, int channels) {
    std::mt19937_64 random(20240611u + static_cast<unsigned>(order));
    const std::vector<cases::Matrix> matrices = rotations(random);
    Vectors vectors;
    vectors.count = static_cast<int>(matrices.size());
    const ReferenceKernel& prepare = reference_kernel(order, "prepare");
    for (std::size_t k = 0; k < matrices.size(); ++k) {
        const std::vector<float> R(matrices[k].begin(), matrices[k].end());
        vectors.matrices.insert(vectors.matrices.end(), R.begin(), R.end());
        if (kernel.name == "apply") {
            std::vector<float> scalars(prepare.output_size);
            prepare.run(R.data(), nullptr, scalars.data());
            vectors.rotations.insert(vectors.rotations.end(), scalars.begin(), scalars.end());
        } else if (kernel.rotation_size > 0) {
            vectors.rotations.insert(vectors.rotations.end(), R.begin(), R.end());
        }
        if (!kernel.has_signal()) continue;
        std::vector<std::vector<double>> parts;
        // Hard signals come last, so that they meet ordinary rotations.
        for (int c = 0; c < channels; ++c)
            parts.push_back(signal(order, kernel.input_size, matrices.size() - 1 - k, random));
        for (int i = 0; i < kernel.input_size; ++i)
            for (int c = 0; c < channels; ++c) vectors.inputs.push_back(static_cast<float>(parts[c][i]));
    }
    return vectors;
}

namespace {

void run_each_channel(const ReferenceKernel& kernel, const float* R, const std::vector<Channels>& in,
                      std::vector<Channels>& out) {
    std::vector<float> one(in.size()), result(out.size());
    for (float Channels::*channel : {&Channels::r, &Channels::g, &Channels::b}) {
        for (std::size_t i = 0; i < in.size(); ++i) one[i] = in[i].*channel;
        kernel.run(R, one.data(), result.data());
        for (std::size_t i = 0; i < out.size(); ++i) out[i].*channel = result[i];
    }
}

}  // namespace

std::vector<float> expected_results(const ReferenceKernel& kernel, const Vectors& vectors, int channels) {
    std::vector<float> results(static_cast<std::size_t>(vectors.count) * kernel.output_size * channels);
    std::vector<Channels> in(kernel.input_size), out(kernel.output_size);
    for (std::size_t k = 0; k < static_cast<std::size_t>(vectors.count); ++k) {
        const float* R = vectors.rotations.data() + k * kernel.rotation_size;
        const float* f = vectors.inputs.data() + k * kernel.input_size * channels;
        float* result = results.data() + k * kernel.output_size * channels;
        if (channels == 1) {
            kernel.run(R, f, result);
            continue;
        }
        for (std::size_t i = 0; i < in.size(); ++i) in[i] = {f[3 * i], f[3 * i + 1], f[3 * i + 2]};
        if (kernel.run_channels != nullptr)
            kernel.run_channels(R, in.data(), out.data());
        else
            run_each_channel(kernel, R, in, out);
        for (const Channels& value : out) {
            *result++ = value.r;
            *result++ = value.g;
            *result++ = value.b;
        }
    }
    return results;
}

std::string difference(const std::vector<float>& got, const std::vector<float>& wanted, int size) {
    if (got.size() != wanted.size()) return fmt::format("{} values, wanted {}", got.size(), wanted.size());
    std::size_t count = 0, first = 0;
    for (std::size_t i = got.size(); i-- > 0;) {
        if (std::bit_cast<std::uint32_t>(got[i]) == std::bit_cast<std::uint32_t>(wanted[i])) continue;
        if (std::isnan(got[i]) && std::isnan(wanted[i])) continue;
        ++count;
        first = i;
    }
    if (count == 0) return {};
    return fmt::format("{} of {} values differ, first vector {} value {}: {} ({:08x}), wanted {} ({:08x})",
                       count, got.size(), first / size, first % size, got[first],
                       std::bit_cast<std::uint32_t>(got[first]), wanted[first],
                       std::bit_cast<std::uint32_t>(wanted[first]));
}

}  // namespace zonal::gpu
