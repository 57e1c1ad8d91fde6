#include "kernels/registry.hpp"

#include <algorithm>

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

int instructions(const std::vector<Kernel>& kernels, const std::string& name) {
    const auto kernel = std::ranges::find(kernels, name, &Kernel::name);
    return graph::count_operations(*kernel).total().instructions();
}

/// The products of lobes of each band's own, where factorizing or resampling by them costs less than by
/// shared ones. Not `rotate_zhf`: where nothing is shared between bands, turning costs more.
std::vector<Kernel> per_band_kernels(const LobeSet& lobes, const std::vector<Kernel>& shared) {
    std::vector<Kernel> own = lobe_kernels(lobes, "per_band");
    const auto costs_less = [&](const char* name) {
        return instructions(own, name) < instructions(shared, name);
    };
    if (!costs_less("factorize") && !costs_less("resample")) return {};
    std::erase_if(own, [](const Kernel& kernel) { return kernel.name == "rotate_zhf"; });
    return own;
}

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
        if (lobes.per_band) append(per_band_kernels(*lobes.per_band, shared));
    }
    if (order >= kSmallestLobeOrder) append(lobe_kernels(LobeSet::ring(order), "stable"));
    return kernels;
}

}  // namespace zonal::kernels
