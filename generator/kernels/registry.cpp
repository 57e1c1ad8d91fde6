#include "kernels/registry.hpp"

#include "graph/counts.hpp"
#include "graph/passes.hpp"
#include "kernels/rotations.hpp"

namespace zonal::kernels {
namespace {

using graph::Kernel;

std::vector<Kernel> lobe_kernels(const LobeSet& lobes, const std::string& variant) {
    std::vector<Kernel> kernels;
    for (const auto build : {build_factorize, build_expand, build_resample, build_lobes, build_rotate_zhf}) {
        kernels.push_back(graph::optimize(build(lobes)));
        kernels.back().variant = variant;
    }
    return kernels;
}

int instructions(const Kernel& kernel) { return graph::count_operations(kernel).total().instructions(); }

}  // namespace

std::vector<Kernel> build_order(int order, const OrderLobeSets& lobes) {
    std::vector<Kernel> kernels = build_rotations(order);
    const auto append = [&](const std::vector<Kernel>& more) {
        kernels.insert(kernels.end(), more.begin(), more.end());
    };
    if (lobes.shared) {
        std::vector<Kernel> shared = lobe_kernels(*lobes.shared, "");
        for (Kernel& kernel : shared) kernel.needs_lobes = true;
        append(shared);
        if (lobes.per_band) {
            // Where they need fewer operations than shared ones; `lobes` belongs to the others.
            std::vector<Kernel> own = lobe_kernels(*lobes.per_band, "per_band");
            std::vector<Kernel> fewer;
            for (std::size_t k = 0; k < own.size(); ++k)
                if (own[k].name == "lobes" || instructions(own[k]) < instructions(shared[k]))
                    fewer.push_back(own[k]);
            if (fewer.size() > 1) append(fewer);
        }
    }
    if (order >= kSmallestLobeOrder) append(lobe_kernels(LobeSet::ring(order), "stable"));
    return kernels;
}

}  // namespace zonal::kernels
