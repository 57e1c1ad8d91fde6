#include <gtest/gtest.h>

#include "bounds/chosen_rotate.hpp"
#include "bounds/published.hpp"
#include "kernels/rotations.hpp"

namespace zonal::kernels {
namespace {

const OrderKernels& order(int n) {
    static std::map<int, OrderKernels> built;
    if (!built.contains(n)) built.emplace(n, build_order_kernels(n));
    return built.at(n);
}

RotateChoice published_choice(int n, Processor processor) {
    return chosen_rotate(order(n), published_bounds(order(n)), processor);
}

/// Every kernel with the same bounds, but for what is said.
RotateChoice choice_by(int n, Processor processor, const std::map<std::string, ErrorBounds>& said) {
    std::map<std::string, ErrorBounds> bounds = said;
    for (const graph::Kernel& kernel : order(n).kernels)
        bounds.try_emplace(kernel.full_name(), ErrorBounds{2e-7, 4e-16});
    return choose_rotate(n, order(n).kernels, bounds, processor);
}

TEST(RotateChoice, waits_for_no_division_on_a_cpu_where_it_need_not) {
    const RotateChoice on_cpu = published_choice(4, Processor::cpu);
    EXPECT_EQ(on_cpu.one, "rotate_tensor");
    EXPECT_EQ(on_cpu.channels, "rotate_channels");
    EXPECT_EQ(published_choice(4, Processor::gpu).one, "rotate_fewest");
}

TEST(RotateChoice, is_the_fewest_instructions_from_order_5_on) {
    for (const int n : {5, 6, 7, 8, 9, 10})
        for (const Processor processor : {Processor::cpu, Processor::gpu})
            EXPECT_EQ(published_choice(n, processor).one, "rotate_fewest") << n;
}

TEST(RotateChoice, has_a_body_of_its_own) {
    EXPECT_EQ(published_choice(3, Processor::cpu).one, "rotate_tensor");  // rotate_fewest forwards to it
    const graph::Kernel rotate = make_rotate(order(4).kernels, published_choice(4, Processor::cpu));
    EXPECT_EQ(rotate.forwards_to, "rotate_tensor");
    EXPECT_EQ(rotate.for_channels, "rotate_channels");
    EXPECT_TRUE(rotate.needs_proper_rotation);  // three channels do
}

TEST(RotateChoice, exceeds_neither_five_times_the_least_error_nor_twice_the_contract) {
    const double fast = call_time(graph::kernel_named(order(5).kernels, "rotate_fewest"), 1, Processor::cpu);
    EXPECT_LT(2 * fast,
              call_time(graph::kernel_named(order(5).kernels, "rotate_accurate"), 1, Processor::cpu));
    const auto with = [](double in_float, double in_double) {
        return choice_by(5, Processor::cpu, {{"rotate_fewest", {in_float, in_double}}}).one;
    };
    EXPECT_EQ(with(1.0e-6, 2.0e-15), "rotate_fewest");
    EXPECT_EQ(with(1.01e-6, 2.0e-15), "rotate_accurate");
    EXPECT_EQ(with(1.0e-6, 2.01e-15), "rotate_accurate");
    // Five times this is more than twice the contract, 2.6e-6 and 7e-15.
    const ErrorBounds accurate{1e-6, 6e-15};
    const auto beside = [&](double in_float, double in_double) {
        return choice_by(5, Processor::cpu,
                         {{"rotate_accurate", accurate}, {"rotate_fewest", {in_float, in_double}}})
            .one;
    };
    EXPECT_EQ(beside(2.6e-6, 7e-15), "rotate_fewest");
    EXPECT_EQ(beside(2.61e-6, 7e-15), "rotate_accurate");
    EXPECT_EQ(beside(2.6e-6, 7.01e-15), "rotate_accurate");
    EXPECT_EQ(choice_by(5, Processor::cpu, {{"rotate_accurate", {1, 1}}, {"rotate_fewest", {1, 1}}}).one,
              "rotate_accurate");
}

TEST(RotateChoice, of_two_that_take_about_the_same_time_is_the_more_accurate) {
    // 127 instructions and 143 differ by more than a tenth; what is as fast but less accurate is not taken.
    EXPECT_EQ(choice_by(4, Processor::gpu, {}).one, "rotate_fewest");
    EXPECT_EQ(choice_by(2, Processor::cpu, {{"rotate_tensor", {2.1e-7, 4e-16}}}).one, "rotate_accurate");
    EXPECT_EQ(choice_by(2, Processor::cpu, {{"rotate_accurate", {2.1e-7, 4e-16}}}).one, "rotate_tensor");
}

}  // namespace
}  // namespace zonal::kernels
