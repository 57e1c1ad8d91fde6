// Plain modules on the Vulkan device against the pointwise oracle: the bounds that banners publish.
#include "support/accuracy.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "gpu/emitted_shaders.hpp"
#include "gpu/published_bounds.hpp"

namespace zonal::gpu {
namespace {

class Accuracy : public testing::TestWithParam<int> {
  protected:
    int order() const { return GetParam(); }
};

TEST_P(Accuracy, plain_modules_are_within_the_published_bounds) {
    auto problems = accuracy::problems<float>(order(), 300, 3000, 20240611u + static_cast<unsigned>(order()));
    if (order() > 6) {  // the oracle's time grows as order^4
        std::size_t number = 0;
        std::erase_if(problems, [&](const accuracy::Problem&) { return number++ % 5 != 0; });
    }
    const auto run = [&](const ReferenceKernel& kernel, const Vectors& vectors) {
        const std::string file = fmt::format("{}/{}.spvasm", order_stem(order()), kernel.name);
        return ModuleRunner(assembled(read_text(spirv_folder() / file)), kernel.output_size).run(vectors);
    };
    expect_within(worst_of_kernels(order(), turning_kernels(order()), problems, 1, run), "module", order());
}

INSTANTIATE_TEST_SUITE_P(orders, Accuracy, testing::ValuesIn(reference_orders()),
                         [](const auto& order) { return fmt::format("order_{}", order.param); });

}  // namespace
}  // namespace zonal::gpu
