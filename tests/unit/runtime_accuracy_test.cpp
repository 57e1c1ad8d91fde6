// `zonal::rotate` as the library ships it against the pointwise oracle: its object code, for processors that
// may have no fused instructions, within what is published for them, and within the contract.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "support/accuracy.hpp"
#include "support/banner.hpp"
#include "support/flushed_denormals.hpp"
#include "zonal/rotate.hpp"

namespace {

using zonal::Rgb;
using zonal::RotationMatrix;
using Problems = std::vector<zonal::accuracy::Problem>;

template <class T>
RotationMatrix<T> matrix(const T* R) {
    return RotationMatrix<T>(std::span<const T, 9>(R, 9));
}

/// The signal in one channel, other values in the others.
template <class T>
void rotate_in_channel(int order, T Rgb<T>::*channel, const T* R, const T* f, T* out) {
    const std::size_t size = static_cast<std::size_t>(order) * order;
    std::vector<Rgb<T>> in(size), turned(size);
    for (std::size_t i = 0; i < size; ++i) {
        in[i] = {T(1), T(-2), T(3)};
        in[i].*channel = f[i];
    }
    zonal::rotate(order, matrix(R), in, turned);
    for (std::size_t i = 0; i < size; ++i) out[i] = turned[i].*channel;
}

/// Every form of the call; `rotate_channels` is what three channels run from order 4 on.
template <class T>
std::vector<zonal::accuracy::Contestant<T>> contestants(int order) {
    const auto one = [order](const T* R, const T* f, T* out) {
        const std::size_t size = static_cast<std::size_t>(order) * order;
        zonal::rotate(order, matrix(R), std::span(f, size), std::span(out, size));
    };
    const auto three = [order, turns = 0](const T* R, const T* f, T* out) mutable {
        constexpr T Rgb<T>::*kChannels[] = {&Rgb<T>::r, &Rgb<T>::g, &Rgb<T>::b};
        rotate_in_channel(order, kChannels[turns++ % 3], R, f, out);
    };
    const std::string of_three = order <= 3 ? "rotate" : "rotate_channels";
    return {{"rotate", one, zonal::banner::bound(order, "rotate").excess},
            {of_three, three, zonal::banner::bound(order, of_three).excess}};
}

template <class T>
void expect_within_bounds(int order, const Problems& problems,
                          const std::vector<zonal::accuracy::Contestant<T>>& kernels) {
    const auto worst = zonal::accuracy::worst_errors<T>(zonal::oracle::Rotation(order), problems, kernels);
    for (std::size_t k = 0; k < kernels.size(); ++k) {
        const zonal::banner::Bound bound = zonal::banner::bound(order, kernels[k].name);
        const double published = sizeof(T) == sizeof(float) ? bound.float_bound : bound.double_bound;
        EXPECT_LE(worst[k].error, published)
            << kernels[k].name << ", form " << k << ", order " << order << ", " << worst[k].name;
        const double contract = zonal::accuracy::contract(kernels[k].name, order, sizeof(T) == sizeof(float));
        EXPECT_LE(worst[k].error_of_rotations, contract)
            << kernels[k].name << ", form " << k << ", order " << order << ", " << worst[k].name_of_rotations;
    }
}

template <class T>
class runtime_accuracy : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(runtime_accuracy, Scalars);

TYPED_TEST(runtime_accuracy, rotate_as_shipped_is_within_its_bounds) {
    for (const int order : zonal::compiled_orders()) {
        const int random_count = order <= 6 ? 2000 : 200;  // the oracle's time grows as order^4
        expect_within_bounds(order,
                             zonal::accuracy::problems<TypeParam>(order, random_count, 100, 4000 + order),
                             contestants<TypeParam>(order));
    }
}

TYPED_TEST(runtime_accuracy, tiny_tilts_are_within_bounds_where_denormals_are_flushed) {
    if (!zonal::FlushedDenormals::kIsSupported) GTEST_SKIP() << "not known how to flush denormals here";
    for (const int order : zonal::compiled_orders()) {
        auto kernels = contestants<TypeParam>(order);
        for (auto& kernel : kernels) {
            kernel.rotate = [rotate = kernel.rotate](const TypeParam* R, const TypeParam* f, TypeParam* out) {
                const zonal::FlushedDenormals flushed;
                rotate(R, f, out);
            };
        }
        expect_within_bounds(order, zonal::accuracy::tiny_tilts(order, 5000 + order), kernels);
    }
}

}  // namespace
