#include "kernels/registry.hpp"

#include "graph/passes.hpp"
#include "kernels/rotations.hpp"

namespace zonal::kernels {

std::vector<graph::Kernel> build_order(int order, const LobeSet* lobes) {
    std::vector<graph::Kernel> kernels = build_rotations(order);
    if (lobes == nullptr) return kernels;
    for (const auto build : {build_factorize, build_expand, build_resample, build_lobes, build_rotate_zhf}) {
        kernels.push_back(graph::optimize(build(*lobes)));
        kernels.back().needs_lobes = true;
    }
    return kernels;
}

}  // namespace zonal::kernels
