// Plain modules on the Vulkan device against the pointwise oracle: the bounds that banners publish.
#include "support/accuracy.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>

#include "gpu/emitted_shaders.hpp"
#include "gpu/vectors.hpp"
#include "support/banner.hpp"

namespace zonal::gpu {
namespace {

/// A kernel turns all signals in one dispatch, and the judge asks for one at a time: what it is going to ask
/// for is noted first.
class Batch {
  public:
    Batch(int order, const ReferenceKernel& kernel) : order_(order), kernel_(kernel) {}

    void note(const float* R, const float* f, float* out) {
        const int size = order_ * order_;
        matrices_.insert(matrices_.end(), R, R + 9);
        signals_.insert(signals_.end(), f, f + size);
        std::fill(out, out + size, 0.0f);
    }

    void run(const Words& words) {
        Vectors vectors;
        vectors.count = static_cast<int>(matrices_.size() / 9);
        if (kernel_.has_signal()) vectors.inputs = signals_;
        vectors.rotations = kernel_.name == "apply" ? scalars() : matrices_;
        results_ = ModuleRunner(words, kernel_.output_size).run(vectors);
    }

    void replay(const float* f, float* out) {
        const float* result = results_.data() + static_cast<std::size_t>(next_++) * kernel_.output_size;
        if (kernel_.has_signal())
            std::copy(result, result + kernel_.output_size, out);
        else if (kernel_.name == "prepare")
            reference_kernel(order_, "apply").run(result, f, out);
        else
            multiply_blocks(result, f, out);
    }

  private:
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
    const ReferenceKernel& kernel_;
    std::vector<float> matrices_, signals_, results_;
    int next_ = 0;
};

class Accuracy : public testing::TestWithParam<int> {};

TEST_P(Accuracy, plain_modules_are_within_the_published_bounds) {
    const int order = GetParam();
    auto problems = accuracy::problems<float>(order, 300, 3000, 20240611u + static_cast<unsigned>(order));
    if (order > 6) {  // the oracle's time grows as order^4
        std::size_t number = 0;
        std::erase_if(problems, [&](const accuracy::Problem&) { return number++ % 5 != 0; });
    }
    std::vector<std::shared_ptr<Batch>> batches;
    std::vector<accuracy::Contestant<float>> contestants;
    for (const ReferenceKernel& kernel : reference_kernels(order)) {
        if (!kernel.makes_turns()) continue;
        const std::string published = bound_name(order, kernel, 1);
        const auto batch = std::make_shared<Batch>(order, kernel);
        const auto contestant = [&](auto rotate) {
            return accuracy::with_mirrors<float>(order,
                                                 {published, rotate, banner::bound(order, published).excess});
        };
        const auto noting =
            contestant([&](const float* R, const float* f, float* out) { batch->note(R, f, out); });
        for (const accuracy::Problem& problem : problems) {
            const std::vector<float> R(problem.rotation.begin(), problem.rotation.end()),
                f(problem.signal.begin(), problem.signal.end());
            std::vector<float> out(f.size());
            noting.rotate(R.data(), f.data(), out.data());
        }
        batch->run(assembled(
            read_text(spirv_folder() / fmt::format("{}/{}.spvasm", order_stem(order), kernel.name))));
        batches.push_back(batch);
        contestants.push_back(
            contestant([batch](const float*, const float* f, float* out) { batch->replay(f, out); }));
    }
    const auto worst = accuracy::worst_errors<float>(oracle::Rotation(order), problems, contestants);
    for (std::size_t k = 0; k < contestants.size(); ++k) {
        const double bound = banner::bound(order, contestants[k].name).float_bound;
        EXPECT_LE(worst[k].error, bound)
            << "order " << order << ", " << contestants[k].name << ", " << worst[k].name;
        RecordProperty(fmt::format("{}_of_bound", k), fmt::format("{:.2f}", worst[k].error / bound));
    }
}

INSTANTIATE_TEST_SUITE_P(orders, Accuracy, testing::ValuesIn(reference_orders()),
                         [](const auto& order) { return fmt::format("order_{}", order.param); });

}  // namespace
}  // namespace zonal::gpu
