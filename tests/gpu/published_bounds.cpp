#include "gpu/published_bounds.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>

#include "gpu/vectors.hpp"
#include "support/banner.hpp"

namespace zonal::gpu {

namespace {

/// A kernel turns all signals at once, and the judge asks for one at a time: what it is going to ask for is
/// noted first.
class Batch {
  public:
    Batch(int order, const ReferenceKernel& kernel, int channels)
        : order_(order), kernel_(kernel), channels_(kernel.has_signal() ? channels : 1) {}

    void note(const float* R, const float* f, float* out) {
        const int size = order_ * order_, judged = judged_channel(count_++);
        matrices_.insert(matrices_.end(), R, R + 9);
        for (int i = 0; i < size; ++i)
            for (int c = 0; c < channels_; ++c) signals_.push_back(c == judged ? f[i] : f[size - 1 - i]);
        std::fill(out, out + size, 0.0f);
    }

    void run(const RunKernel& run_kernel) {
        Vectors vectors;
        vectors.count = count_;
        vectors.matrices = matrices_;
        if (kernel_.has_signal()) vectors.inputs = signals_;
        vectors.rotations = kernel_.name == "apply" ? scalars() : matrices_;
        results_ = run_kernel(kernel_, vectors);
    }

    void replay(const float* f, float* out) {
        const int size = kernel_.output_size, channel = judged_channel(next_);
        const float* result = results_.data() + static_cast<std::size_t>(next_++) * size * channels_;
        if (kernel_.has_signal())
            for (int i = 0; i < size; ++i) out[i] = result[i * channels_ + channel];
        else if (kernel_.name == "prepare")
            reference_kernel(order_, "apply").run(result, f, out);
        else
            multiply_blocks(result, f, out);
    }

  private:
    int judged_channel(int number) const { return number % channels_; }
    std::vector<float> scalars() const {
        const ReferenceKernel& prepare = reference_kernel(order_, "prepare");
        const std::size_t count = matrices_.size() / 9;
        std::vector<float> all(count * prepare.output_size);
        for (std::size_t k = 0; k < count; ++k)
            prepare.run(matrices_.data() + 9 * k, nullptr, all.data() + k * prepare.output_size);
        return all;
    }
    /// As a shader would: a product and a sum of two roundings.
    void multiply_blocks(const float* entry, const float* f, float* out) const {
        for (int l = 0; l < order_; ++l) {
            for (int i = l * l; i < (l + 1) * (l + 1); ++i) {
                float sum = 0;
                for (int j = l * l; j < (l + 1) * (l + 1); ++j) sum += *entry++ * f[j];
                out[i] = sum;
            }
        }
    }

    int order_;
    ReferenceKernel kernel_;
    int channels_;
    std::vector<float> matrices_, signals_, results_;
    int count_ = 0, next_ = 0;
};

}  // namespace

std::vector<WorstOfKernel> worst_of_kernels(int order, const std::vector<ReferenceKernel>& kernels,
                                            const std::vector<accuracy::Problem>& problems, int channels,
                                            const RunKernel& run) {
    std::vector<accuracy::Contestant<float>> contestants;
    std::vector<WorstOfKernel> all;
    for (const ReferenceKernel& kernel : kernels) {
        const std::string published = bound_name(order, kernel, channels);
        const auto batch = std::make_shared<Batch>(order, kernel, channels);
        const banner::Bound bound = banner::bound(order, published);
        const auto contestant = [&](auto rotate) {
            const accuracy::Contestant<float> given{published, rotate, bound.excess};
            return bound.takes_mirrors ? given : accuracy::with_mirrors<float>(order, given);
        };
        const auto noting =
            contestant([&](const float* R, const float* f, float* out) { batch->note(R, f, out); });
        for (const accuracy::Problem& problem : problems) {
            const std::vector<float> R(problem.rotation.begin(), problem.rotation.end()),
                f(problem.signal.begin(), problem.signal.end());
            std::vector<float> out(f.size());
            noting.rotate(R.data(), f.data(), out.data());
        }
        batch->run(run);
        contestants.push_back(
            contestant([batch](const float*, const float* f, float* out) { batch->replay(f, out); }));
        all.push_back({.kernel = kernel.name, .bound = bound.float_bound});
    }
    const auto worst = accuracy::worst_errors<float>(oracle::Rotation(order), problems, contestants);
    for (std::size_t k = 0; k < all.size(); ++k) {
        all[k].error = worst[k].error;
        all[k].problem = worst[k].name;
    }
    return all;
}

std::vector<ReferenceKernel> turning_kernels(int order) {
    std::vector<ReferenceKernel> kernels = reference_kernels(order);
    std::erase_if(kernels, [](const ReferenceKernel& kernel) { return !kernel.makes_turns(); });
    return kernels;
}

std::vector<accuracy::Problem> tiny_tilts(int order) {
    constexpr double kTilt = 1.08e-19;
    std::vector<accuracy::Problem> problems{{"the smallest case",
                                             {1, 0, 0, 0, 1, kTilt, 0, -kTilt, 1},
                                             std::vector<double>(order * order, 0.25)}};
    std::mt19937_64 random(20240611u + static_cast<unsigned>(order));
    for (const cases::Case& tilt : cases::tiny_tilts(random))
        problems.push_back({tilt.name, tilt.rotation, cases::random_signal(order, random)});
    return problems;
}

void expect_within(const std::vector<WorstOfKernel>& worst, const std::string& form, int order) {
    for (std::size_t k = 0; k < worst.size(); ++k) {
        const WorstOfKernel& of = worst[k];
        EXPECT_LE(of.error, of.bound)
            << form << ", order " << order << ", " << of.kernel << ", " << of.problem;
        testing::Test::RecordProperty(fmt::format("{}_{}_of_bound", form, k),
                                      fmt::format("{:.2f}", of.error / of.bound));
    }
}

}  // namespace zonal::gpu
