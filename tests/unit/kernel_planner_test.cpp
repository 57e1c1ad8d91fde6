#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "graph/evaluate.hpp"
#include "graph/passes.hpp"
#include "kernels/planner.hpp"
#include "kernels/rotations.hpp"
#include "support/oracle.hpp"

namespace zonal::kernels {
namespace {

using testing::HasSubstr;

/// ‖kernel - oracle‖ on one rotation and one signal.
double error_of(int order, const graph::Kernel& kernel) {
    const double r[9] = {2.0 / 3, -2.0 / 3, 1.0 / 3, 1.0 / 3, 2.0 / 3, 2.0 / 3, -2.0 / 3, -1.0 / 3, 2.0 / 3};
    std::vector<double> f, out(order * order);
    for (int i = 0; i < order * order; ++i) f.push_back(std::cos(3.0 * i));
    graph::Evaluator<double> run(kernel);
    run({r, f.data()}, out.data());
    oracle::Matrix3 rotation;
    std::copy(r, r + 9, rotation.begin());
    const auto expected = oracle::Rotation(order)(rotation, {f.begin(), f.end()});
    oracle::Real sum = 0;
    for (int i = 0; i < order * order; ++i) sum += (out[i] - expected[i]) * (out[i] - expected[i]);
    return static_cast<double>(std::sqrt(sum));
}

TEST(Planner, every_way_to_turn_a_band_turns_it) {
    // 1e-13 is far below what a wrong sign or constant does and far above rounding.
    constexpr int kOrder = 9;
    const Plan cheapest = cheapest_plan(kOrder, {1, false});
    for (int l = 1; l < kOrder; ++l) {
        for (const Alternative& way : alternatives(kOrder, l)) {
            Plan plan = cheapest;
            plan[l - 1] = way.method;
            EXPECT_LT(error_of(kOrder, build_plan(kOrder, plan)), 1e-13)
                << "band " << l << ", " << way.method->name;
        }
    }
}

TEST(Planner, one_vector_of_order_3_is_contracted_and_takes_mirrors) {
    const Plan plan = cheapest_plan(3, {1, true});
    EXPECT_EQ(plan[1]->name, "contraction");
    EXPECT_FALSE(build_plan(3, plan).needs_proper_rotation);
}

TEST(Planner, one_vector_of_order_4_shares_the_angles_among_its_bands) {
    const Plan plan = cheapest_plan(4, {1, false});
    EXPECT_EQ(plan[1]->family, "zxzxz");
    EXPECT_EQ(plan[2]->family, "zxzxz");
    EXPECT_TRUE(build_plan(4, plan).needs_proper_rotation);
}

TEST(Planner, nothing_weighs_less_than_the_plan_but_for_one_band_changed) {
    for (const int vectors : {1, 3, 64}) {
        const Workload workload{vectors, false};
        const Plan plan = cheapest_plan(6, workload);
        const int least = weight(build_plan(6, plan), workload);
        int judged = 0;
        for (int l = 1; l < 6; ++l) {
            for (const Alternative& way : alternatives(6, l)) {
                if (!is_fit_for(*way.method, 6, workload)) continue;
                Plan changed = plan;
                changed[l - 1] = way.method;
                EXPECT_GE(weight(build_plan(6, changed), workload), least) << way.method->name;
                ++judged;
            }
        }
        EXPECT_GE(judged, 10);  // of five bands at least two ways each
    }
}

TEST(Planner, a_workload_with_mirrors_gets_a_kernel_for_mirrors) {
    EXPECT_FALSE(build_plan(5, cheapest_plan(5, {1, true})).needs_proper_rotation);
}

TEST(Planner, orders_11_to_14_multiply_no_more_than_their_goals) {
    const std::map<int, int> goals{{11, 1600}, {12, 2010}, {13, 2480}, {14, 3010}};
    for (const auto& [order, goal] : goals) {
        const graph::Cost cost = graph::count_operations(build_plan(order, cheapest_plan(order, {1, false})));
        const auto multiplications = [](const graph::Counts& counts) { return counts.mul + counts.fma; };
        EXPECT_LE(multiplications(cost.per_rotation) + multiplications(cost.per_vector), goal) << order;
    }
}

TEST(Rotations, tensors_alone_are_a_kernel_where_every_band_has_one) {
    for (const int order : {2, 3, 4, 5, 6}) {
        const std::vector<graph::Kernel> kernels = build_rotations(order);
        const auto tensor = std::ranges::find(kernels, "rotate_tensor", &graph::Kernel::name);
        ASSERT_EQ(tensor != kernels.end(), order <= 4) << order;
        if (tensor == kernels.end()) continue;
        EXPECT_FALSE(tensor->needs_proper_rotation);
        EXPECT_EQ(graph::count_operations(*tensor).total().other, 0);
        const graph::Kernel& fewest = graph::kernel_named(kernels, "rotate_fewest");
        EXPECT_EQ(fewest.forwards_to, order <= 3 ? "rotate_tensor" : "") << order;
        EXPECT_EQ(graph::count_operations(fewest).total().other > 0, order > 3) << order;
    }
}

TEST(Rotations, prepare_and_apply_cost_together_what_their_kernel_does) {
    const std::vector<graph::Kernel> kernels = build_rotations(5);
    const auto find = [&](const std::string& name) {
        return *std::find_if(kernels.begin(), kernels.end(), [&](const auto& k) { return k.name == name; });
    };
    const graph::Cost whole = graph::count_operations(build_plan(5, plan_order(5).many));
    EXPECT_EQ(graph::count_operations(find("prepare")).total().instructions(),
              whole.per_rotation.instructions());
    EXPECT_EQ(graph::count_operations(find("apply")).total().instructions(), whole.per_vector.instructions());
    EXPECT_EQ(find("prepare").output.size, find("apply").inputs[0].size);
}

}  // namespace
}  // namespace zonal::kernels
