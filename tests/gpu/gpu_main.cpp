// The process's Vulkan device is made before the first test, so that a machine without one is told so in one
// line, and closed after the last.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>

#include "gpu/module_runner.hpp"

int main(int argc, char** argv) {
    testing::InitGoogleTest(&argc, argv);
    if (testing::GTEST_FLAG(list_tests)) return RUN_ALL_TESTS();
    // lavapipe compiles thousands of straight lines a third faster without LLVM's optimizer.
    ::setenv("GALLIVM_PERF", "nopt", 0);
    try {
        fmt::print("{}\n", zonal::gpu::device_name());
        const int status = RUN_ALL_TESTS();
        zonal::gpu::close_device();
        return status;
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 1;
    }
}
