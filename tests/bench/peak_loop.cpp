// The measured peak: a loop of independent multiply-adds on packs. CMake compiles this file once for each
// instruction set and type, as runtime/src/batch/kernels.cpp.

#define HWY_COMPILE_ONLY_STATIC
#include <hwy/highway.h>

#include "peak.hpp"

namespace zonal::bench {
namespace {

namespace hn = hwy::HWY_NAMESPACE;
using D = hn::ScalableTag<ZONAL_BATCH_SCALAR>;

HWY_NOINLINE double run(std::size_t rounds) {
    const D d;
    const auto half = hn::Set(d, ZONAL_BATCH_SCALAR(0.5));
    const auto one = hn::Set(d, ZONAL_BATCH_SCALAR(1));
    hn::Vec<D> x[kPeakChains];
    for (auto& chain : x) chain = one;
    static_assert(kPeakChains == 12);
    for (std::size_t round = 0; round < rounds; ++round) {
        x[0] = hn::MulAdd(x[0], half, one), x[1] = hn::MulAdd(x[1], half, one);
        x[2] = hn::MulAdd(x[2], half, one), x[3] = hn::MulAdd(x[3], half, one);
        x[4] = hn::MulAdd(x[4], half, one), x[5] = hn::MulAdd(x[5], half, one);
        x[6] = hn::MulAdd(x[6], half, one), x[7] = hn::MulAdd(x[7], half, one);
        x[8] = hn::MulAdd(x[8], half, one), x[9] = hn::MulAdd(x[9], half, one);
        x[10] = hn::MulAdd(x[10], half, one), x[11] = hn::MulAdd(x[11], half, one);
    }
    for (std::size_t chain = 1; chain < kPeakChains; ++chain) x[0] = hn::Add(x[0], x[chain]);
    return static_cast<double>(hn::GetLane(x[0]));
}

}  // namespace

Peak ZONAL_BATCH_ENTRY();
Peak ZONAL_BATCH_ENTRY() {
    return {hn::MaxLanes(D()), HWY_TARGET <= HWY_AVX2 || HWY_TARGET == HWY_NEON, run};
}

}  // namespace zonal::bench
