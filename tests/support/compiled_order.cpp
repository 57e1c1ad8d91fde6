// The generated kernels of one order, ZONAL_TEST_ORDER in ZONAL_TEST_HEADER, in every type that a test runs
// them in. ZONAL_TEST_HAS_LOBES, …_PER_BAND, …_TENSOR: which kernels the header has beside the others.
#include ZONAL_TEST_HEADER

#include "support/compiled_kernels.hpp"

namespace zonal {
namespace {

#define ZONAL_JOIN_(a, b) a##b
#define ZONAL_JOIN(a, b) ZONAL_JOIN_(a, b)
namespace order = ZONAL_JOIN(order, ZONAL_TEST_ORDER);

static_assert(order::kHasLobes == ZONAL_TEST_HAS_LOBES &&
              order::kHasPerBandLobes == ZONAL_TEST_HAS_PER_BAND &&
              order::kHasTensor == ZONAL_TEST_HAS_TENSOR);

template <class T, class V = T>
RotateKernels<T, V> rotate_kernels() {
    return {
        .rotate = order::rotate<T, V>, .rotate_accurate = order::rotate_accurate<T, V>,
        .rotate_fewest = order::rotate_fewest<T, V>,
#if ZONAL_TEST_HAS_TENSOR
        .rotate_tensor = order::rotate_tensor<T, V>,
#endif
        .prepare = order::prepare<T>, .blocks = order::blocks<T>, .apply = order::apply<T, V>
    };
}

#define ZONAL_PRODUCTS(place, T)                                                                \
    {                                                                                           \
        .lobes = place::lobes<T>, .factorize = place::factorize<T>, .expand = place::expand<T>, \
        .resample = place::resample<T>, ZONAL_ZHF(T),                                           \
    }
#define ZONAL_VARIANT(prefix_, layout_, place)                                                \
    {                                                                                         \
        .prefix = prefix_, .layout = LobeVariant::Layout::layout_, .order = ZONAL_TEST_ORDER, \
        .in_float = {ZONAL_ZHF(float)}, .in_double = ZONAL_PRODUCTS(place, double),           \
        .counting = ZONAL_PRODUCTS(place, Counting), ZONAL_ZHF_CHANNELS,                      \
        .factorize_rgb = place::factorize<Rgb<double>>,                                       \
    }

std::vector<LobeVariant> lobe_variants() {
    std::vector<LobeVariant> variants;
#if ZONAL_TEST_HAS_LOBES
#define ZONAL_ZHF(T) .rotate_zhf = order::rotate_zhf<T, T>
#define ZONAL_ZHF_CHANNELS .rotate_zhf_channels = order::rotate_zhf<float, Channels>
    variants.push_back(ZONAL_VARIANT("", shared, order));
#undef ZONAL_ZHF
#undef ZONAL_ZHF_CHANNELS
#define ZONAL_ZHF(T) .rotate_zhf = order::stable::rotate_zhf<T, T>
#define ZONAL_ZHF_CHANNELS .rotate_zhf_channels = order::stable::rotate_zhf<float, Channels>
    variants.push_back(ZONAL_VARIANT("stable::", ring, order::stable));
#undef ZONAL_ZHF
#undef ZONAL_ZHF_CHANNELS
#endif
#if ZONAL_TEST_HAS_PER_BAND
#define ZONAL_ZHF(T) .rotate_zhf = nullptr
#define ZONAL_ZHF_CHANNELS .rotate_zhf_channels = nullptr
    variants.push_back(ZONAL_VARIANT("per_band::", per_band, order::per_band));
#undef ZONAL_ZHF
#undef ZONAL_ZHF_CHANNELS
#endif
    return variants;
}

[[maybe_unused]] const bool kIsAdded = add_compiled_order({
    .order = ZONAL_TEST_ORDER, .scalars = order::kScalars, .takes_mirrors = order::kTakesMirrors != 0,
    .in_float = rotate_kernels<float>(), .in_double = rotate_kernels<double>(),
    .in_channels = rotate_kernels<float, Channels>(), .counting = rotate_kernels<Counting>(),
    .rotate_rgb = order::rotate<double, Rgb<double>>,
    .rotate_counting_rgb = order::rotate<Counting, CountingRgb>,
    .rotate_counting_signal = order::rotate<double, CountingSignal>,
#if ZONAL_TEST_HAS_TENSOR
    .rotate_tensor_counting_signal = order::rotate_tensor<double, CountingSignal>,
#endif
    .lobes = lobe_variants(),
});

}  // namespace
}  // namespace zonal
