#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "graph/register_schedule.hpp"
#include "kernels/registry.hpp"
#include "support/empty_kernel.hpp"

namespace zonal::graph {
namespace {

/// A kernel of order 5 without lobes.
const Kernel& order_5(const std::string& name) {
    static const std::vector<Kernel> all = kernels::build_order(5, {});
    for (const Kernel& kernel : all)
        if (kernel.name == name) return kernel;
    throw std::logic_error("no kernel " + name);
}

/// Why the order cannot run, or nothing.
std::string fault_of(const Kernel& kernel, const std::vector<Statement>& statements) {
    std::set<Id> known;
    std::set<int> stored;
    const auto is_known = [&](Id id) { return kernel.graph[id].op == Op::constant || known.contains(id); };
    for (const Statement& statement : statements) {
        if (statement.is_store) {
            if (!is_known(statement.node)) return "stores what is not there";
            if (!stored.insert(statement.index).second) return "stores an element twice";
            continue;
        }
        if (!std::ranges::all_of(kernel.graph[statement.node].operands, is_known))
            return "reads what is not there";
        if (!known.insert(statement.node).second) return "makes a value twice";
    }
    return stored.size() == kernel.stores.size() ? "" : "stores too little";
}

/// Whether an element of the signal is read after that element of the output was stored.
bool reads_what_it_stored(const Kernel& kernel, const std::vector<Statement>& statements) {
    std::set<int> stored;
    for (const Statement& statement : statements) {
        const Node& node = kernel.graph[statement.node];
        if (statement.is_store)
            stored.insert(statement.index);
        else if (node.op == Op::input && node.kind == Kind::signal && stored.contains(node.index))
            return true;
    }
    return false;
}

TEST(RegisterSchedule, everything_is_made_once_before_it_is_used) {
    for (const char* name : {"rotate_fewest", "rotate_accurate", "prepare", "apply", "blocks"}) {
        const Kernel& kernel = order_5(name);
        for (const int channels : {1, 3})
            EXPECT_EQ(fault_of(kernel, schedule_for_registers(kernel, channels)), "") << name;
    }
}

TEST(RegisterSchedule, what_is_safe_in_place_stays_so) {
    for (const char* name : {"rotate_fewest", "rotate_accurate", "apply"}) {
        const Kernel& kernel = order_5(name);
        EXPECT_FALSE(reads_what_it_stored(kernel, schedule_for_registers(kernel))) << name;
    }
}

TEST(RegisterSchedule, sums_that_do_not_wait_for_each_other_hold_two_registers) {
    Kernel kernel = empty_kernel();
    std::vector<Value> sums;
    for (int i = 0; i < 4; ++i) sums.push_back(kernel.input(0, 2 * i) + kernel.input(0, 2 * i + 1));
    for (int i = 0; i < 4; ++i) kernel.store(i, sums[i], 0);
    EXPECT_EQ(peak_registers(kernel, schedule_for_registers(kernel)), 2);
}

TEST(RegisterSchedule, a_signal_of_three_channels_holds_three_registers_a_value) {
    Kernel kernel = empty_kernel();
    kernel.store(0, kernel.input(0, 0) * kernel.input(1, 0), 0);
    EXPECT_EQ(peak_registers(kernel, schedule_for_registers(kernel, 1), 1), 2);
    EXPECT_EQ(peak_registers(kernel, schedule_for_registers(kernel, 3), 3), 4);
}

TEST(RegisterSchedule, dense_rows_are_used_as_they_are_made) {
    // The matrix of band 4 has 81 entries; row by row they need not be there together with band 3's 49, the
    // rotation and the signal.
    const Kernel& kernel = order_5("rotate_accurate");
    EXPECT_LT(peak_registers(kernel, schedule_for_registers(kernel)), 81);
}

TEST(RegisterSchedule, steps_follow_one_another) {
    const Kernel& kernel = order_5("blocks");
    std::map<int, int> step_of;
    for (const Store& store : kernel.stores) step_of[store.index] = store.step;
    std::vector<int> steps;
    for (const Statement& statement : schedule_for_registers(kernel))
        if (statement.is_store) steps.push_back(step_of[statement.index]);
    EXPECT_THAT(steps, testing::Contains(2));
    EXPECT_TRUE(std::ranges::is_sorted(steps));
}

TEST(RegisterSchedule, columns_of_a_dense_matrix_do_not_wait_for_each_other) {
    // Band 3 has 49 entries and R 9: as many are there when band 4 is made of the whole of it.
    EXPECT_LT(peak_registers(order_5("blocks"), schedule_for_registers(order_5("blocks"))), 49 + 9);
}

TEST(RegisterSchedule, weights_of_lobes_that_share_sums_come_before_the_lobes) {
    // Of the ring's lobes each shares what its weights are made of with one far from it. The 25 values of the
    // signal, 27 weights and 21 sums are not there together.
    const Kernel& kernel = order_5("rotate_zhf");
    ASSERT_EQ(kernel.variant, "stable");
    EXPECT_LT(peak_registers(kernel, schedule_for_registers(kernel)), 25 + 27 + 21);
}

}  // namespace
}  // namespace zonal::graph
