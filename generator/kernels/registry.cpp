#include "kernels/registry.hpp"

#include "graph/passes.hpp"

namespace zonal::kernels {

std::vector<graph::Kernel> build_order(const LobeSet& lobes) {
    std::vector<graph::Kernel> kernels;
    for (const auto build : {build_factorize, build_expand, build_resample, build_lobes, build_rotate_zhf})
        kernels.push_back(graph::optimize(build(lobes)));
    return kernels;
}

}  // namespace zonal::kernels
