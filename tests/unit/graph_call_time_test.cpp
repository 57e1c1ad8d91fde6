#include <gtest/gtest.h>

#include "graph/call_time.hpp"

namespace zonal::graph {
namespace {

constexpr int kMany = 300;  // several times what waits at once

/// out[i] = f[i] + f[0], or each the sum of the one before and f[i].
Kernel sums(bool is_chain) {
    Kernel kernel;
    kernel.inputs = {{"f", Kind::signal, kMany + 1, ""}};
    kernel.output = {"out", Kind::signal, kMany, ""};
    Value sum = kernel.input(0, 0);
    for (int i = 0; i < kMany; ++i) {
        const Value next = sum + kernel.input(0, i + 1);
        kernel.store(i, next, 0);
        if (is_chain) sum = next;
    }
    return kernel;
}

TEST(CallTime, of_independent_sums_is_half_their_number) {
    EXPECT_NEAR(call_cycles(sums(false)), kMany / 2.0, 1);
    EXPECT_NEAR(call_cycles(sums(false), 3), 3 * kMany / 2.0, 1);
}

TEST(CallTime, of_a_chain_longer_than_what_waits_is_its_latency) {
    constexpr int kLatency = 4;
    // The end of a call meets the beginning of the next.
    const double longest = kLatency * kMany;
    EXPECT_LE(call_cycles(sums(true)), longest);
    EXPECT_GE(call_cycles(sums(true)), 0.7 * longest);
}

TEST(CallTime, of_divisions_is_that_of_one_divider) {
    Kernel kernel;
    constexpr int kDivisions = 20, kEach = 4;
    kernel.inputs = {{"R", Kind::rotation, kDivisions, ""}};
    kernel.output = {"out", Kind::rotation, kDivisions, ""};
    for (int i = 0; i < kDivisions; ++i) kernel.store(i, Number(1) / kernel.input(0, i), 0);
    EXPECT_NEAR(call_cycles(kernel), kDivisions * kEach, 1);
}

TEST(CallTime, of_no_operation_is_none) {
    Kernel kernel;
    kernel.inputs = {{"f", Kind::signal, 1, ""}};
    kernel.output = {"out", Kind::signal, 1, ""};
    kernel.store(0, kernel.input(0, 0), 0);
    EXPECT_EQ(call_cycles(kernel), 0);
}

}  // namespace
}  // namespace zonal::graph
