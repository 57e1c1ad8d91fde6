// Every emitted compute module on the Vulkan device beside the generated C++ kernel that was compiled without
// fused instructions.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <set>

#include "gpu/vectors.hpp"

namespace zonal::gpu {
namespace {

class Kernels : public testing::TestWithParam<int> {
  protected:
    int order() const { return GetParam(); }
    Words module(const std::string& name) const {
        return assembled(read_text(spirv_folder() / fmt::format("{}_{}.spvasm", order_stem(order()), name)));
    }
};

TEST_P(Kernels, are_those_of_cpp) {
    std::set<std::string> expected{order_stem(order()) + ".spvasm"}, found;
    for (const ReferenceKernel& kernel : reference_kernels(order())) {
        const std::string stem = fmt::format("{}_{}", order_stem(order()), kernel.name);
        for (const char* form : {"", "_precise"}) expected.insert(stem + form + ".spvasm");
        if (kernel.has_signal()) expected.insert(stem + "_rgb.spvasm");
    }
    for (const auto& entry : std::filesystem::directory_iterator(spirv_folder())) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(order_stem(order()))) found.insert(name);
    }
    EXPECT_EQ(found, expected);
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

TEST_P(Kernels, modules_of_three_channels_give_the_bits_of_cpp) {
    for (const ReferenceKernel& kernel : reference_kernels(order())) {
        if (!kernel.has_signal()) continue;
        const ModuleRunner runner(module(kernel.name + "_rgb"), 3 * kernel.output_size);
        const Vectors vectors = test_vectors(order(), kernel, 3);
        const auto got = runner.run(vectors), wanted = expected_results(kernel, vectors, 3);
        EXPECT_EQ(difference(got, wanted, 3 * kernel.output_size), "")
            << kernel.name << ", " << largest_relative_difference(got, wanted, 3 * kernel.output_size)
            << " units";
    }
}

TEST_P(Kernels, plain_modules_give_the_bits_of_cpp) {
    for (const ReferenceKernel& kernel : reference_kernels(order())) {
        const ModuleRunner runner(module(kernel.name), kernel.output_size);
        const Vectors vectors = test_vectors(order(), kernel, 1);
        const auto got = runner.run(vectors), wanted = expected_results(kernel, vectors, 1);
        EXPECT_EQ(difference(got, wanted, kernel.output_size), "")
            << kernel.name << ", " << largest_relative_difference(got, wanted, kernel.output_size)
            << " units";
    }
}

INSTANTIATE_TEST_SUITE_P(orders, Kernels, testing::ValuesIn(reference_orders()));

}  // namespace
}  // namespace zonal::gpu
