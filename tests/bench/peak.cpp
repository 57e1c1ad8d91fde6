#include "peak.hpp"

#include "target_list.hpp"

namespace zonal::bench {

#define ZONAL_BENCH_PEAK(name, highway_target) \
    Peak name##_float();                       \
    Peak name##_double();
ZONAL_FOR_EACH_BATCH_TARGET(ZONAL_BENCH_PEAK)
#undef ZONAL_BENCH_PEAK

template <>
Peak peak_of<float>(std::string_view target) {
#define ZONAL_BENCH_PEAK(name, highway_target) \
    if (target == #name) return name##_float();
    ZONAL_FOR_EACH_BATCH_TARGET(ZONAL_BENCH_PEAK)
#undef ZONAL_BENCH_PEAK
    return baseline_float();
}

template <>
Peak peak_of<double>(std::string_view target) {
#define ZONAL_BENCH_PEAK(name, highway_target) \
    if (target == #name) return name##_double();
    ZONAL_FOR_EACH_BATCH_TARGET(ZONAL_BENCH_PEAK)
#undef ZONAL_BENCH_PEAK
    return baseline_double();
}

}  // namespace zonal::bench
