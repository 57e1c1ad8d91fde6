// rotate_zhf against the pointwise oracle, float and double, every order: the numbers the project promises.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "support/accuracy.hpp"
#include "support/kernels.hpp"

namespace zonal {
namespace {

constexpr int kRandomRotations = 10000;
constexpr std::uint64_t kSeed = 20240611;

std::string read_header(int order) {
    std::ifstream stream(fmt::format("{}/zonal/order{:02}.hpp", ZONAL_GENERATED_DIR, order));
    std::stringstream text;
    text << stream.rdbuf();
    return text.str();
}

/// The bound that the banner of an order's header publishes for a kernel.
double published_bound(int order, const std::string& kernel, bool is_float) {
    const std::string text = read_header(order);
    std::smatch match;
    if (!std::regex_search(
            text, match,
            std::regex(kernel + R"( relative error ([0-9.e+-]+) \(float\), ([0-9.e+-]+) \(double\))"))) {
        ADD_FAILURE() << "order " << order << " publishes no bound for " << kernel;
        return 0;
    }
    return std::stod(match[is_float ? 1 : 2]);
}

template <int N, class T>
void expect_within_bounds() {
    constexpr bool kIsFloat = std::is_same_v<T, float>;
    const auto rotate = [](const T* R, const T* f, T* out) { Order<N>::rotate_zhf(R, f, out); };
    const accuracy::Worst worst = accuracy::worst_error<T>(N, kRandomRotations, kSeed + N, rotate);
    EXPECT_LE(worst.beyond_excused, published_bound(N, "rotate_zhf", kIsFloat))
        << "order " << N << ", " << worst.name;
    EXPECT_LE(worst.beyond_excused, accuracy::zhf_contract(N, kIsFloat))
        << "order " << N << ", " << worst.name;
}

#define ZONAL_ACCURACY_TESTS(N)                                                                     \
    TEST(ZhfAccuracy, order_##N##_float_is_within_its_bounds) { expect_within_bounds<N, float>(); } \
    TEST(ZhfAccuracy, order_##N##_double_is_within_its_bounds) { expect_within_bounds<N, double>(); }
ZONAL_FOR_EACH_ORDER(ZONAL_ACCURACY_TESTS)

}  // namespace
}  // namespace zonal
