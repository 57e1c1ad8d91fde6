// What a batch takes of the stack, on threads whose stack is filled before and looked at afterwards.

#include <gtest/gtest.h>
#include <pthread.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "batch/targets.hpp"
#include "zonal/batch.hpp"
#include "zonal/rotate.hpp"

namespace {

/// Sanitizers have frames of their own.
#if defined(__SANITIZE_ADDRESS__)
constexpr bool kIsSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
constexpr bool kIsSanitized = true;
#else
constexpr bool kIsSanitized = false;
#endif
#else
constexpr bool kIsSanitized = false;
#endif

/// The door keeps its values on the stack where it is compiled to be debugged; kernels are optimised always.
#ifdef NDEBUG
constexpr std::size_t kOfDebugging = 0;
#else
constexpr std::size_t kOfDebugging = 4096;
#endif

/// Runs `body` on a thread; returns the bytes of its stack that were written.
std::size_t stack_used_by(const std::function<void()>& body) {
    constexpr std::size_t kWords = (std::size_t{1} << 20) / sizeof(std::uint64_t);
    constexpr std::uint64_t kUnused = 0x5a6f6e616c5a6f6e;
    static std::vector<std::uint64_t> memory(kWords + 512);
    std::ranges::fill(memory, kUnused);
    void* const begin =
        reinterpret_cast<void*>((reinterpret_cast<std::uintptr_t>(memory.data()) + 4095) / 4096 * 4096);
    pthread_attr_t attributes;
    pthread_attr_init(&attributes);
    EXPECT_EQ(pthread_attr_setstack(&attributes, begin, kWords * sizeof(std::uint64_t)), 0);
    pthread_t thread;
    const auto run = [](void* argument) -> void* {
        (*static_cast<const std::function<void()>*>(argument))();
        return nullptr;
    };
    EXPECT_EQ(pthread_create(&thread, &attributes, run, const_cast<std::function<void()>*>(&body)), 0);
    pthread_join(thread, nullptr);
    pthread_attr_destroy(&attributes);
    const auto* const words = static_cast<const std::uint64_t*>(begin);
    const auto* const first = std::find_if(words, words + kWords, [](auto word) { return word != kUnused; });
    return static_cast<std::size_t>(words + kWords - first) * sizeof(std::uint64_t);
}

template <class T>
void expect_little_stack() {
    const zonal::RotationMatrix<T> R(0, -1, 0, 1, 0, 0, 0, 0, 1);
    constexpr std::size_t kCount = 40;
    const std::size_t by_itself = stack_used_by([] {});
    for (const std::string_view target : zonal::batch::runnable_targets()) {
        ASSERT_TRUE(zonal::batch::choose_target(target));
        for (const int order : zonal::compiled_orders()) {
            if (order > 10) continue;
            const std::size_t length = static_cast<std::size_t>(order) * order;
            for (const int channels : {1, 3, 5, 7, 15, 20, 70}) {
                const std::vector<T> in(length * channels * kCount, T(1));
                std::vector<T> out(in.size());
                const std::vector<zonal::RotationMatrix<T>> each(kCount, R);
                const zonal::BatchLayout layout{.count = kCount, .channels = channels};
                const std::size_t used = stack_used_by([&] {
                    for (const bool is_streamed : {false, true}) {
                        zonal::batch::set_streamed_bytes(is_streamed ? 0 : zonal::batch::kStreamedBytes);
                        zonal::rotate_all(order, R, layout, std::span<const T>(in), std::span<T>(out));
                        zonal::rotate_each(order, zonal::RotationMatrices<T>(each), layout,
                                           std::span<const T>(in), std::span<T>(out));
                    }
                    const std::size_t plane = channels * kCount;
                    const zonal::PlanarLayout planar{.count = kCount, .channels = channels};
                    const zonal::Planes<const T> from(in, plane);
                    const zonal::Planes<T> to(out, plane);
                    zonal::rotate_all(order, R, planar, from, to);
                    zonal::rotate_each(order, zonal::RotationMatrices<T>(each), planar, from, to);
                });
                EXPECT_LE(used, by_itself + 65536 + kOfDebugging)
                    << target << ", order " << order << ", channels " << channels;
            }
        }
    }
    zonal::batch::choose_target("");
    zonal::batch::set_streamed_bytes(zonal::batch::kStreamedBytes);
}

TEST(runtime_batch_stack, is_as_stated) {
    if (kIsSanitized) GTEST_SKIP() << "sanitizers have frames of their own";
    expect_little_stack<float>();
    expect_little_stack<double>();
}

}  // namespace
