#include "kernels/registry.hpp"

#include <algorithm>

#include "graph/counts.hpp"
#include "graph/passes.hpp"

namespace zonal::kernels {
namespace {

using graph::Kernel;

using Builder = Kernel (*)(const LobeSet&);
const std::vector<Builder> kProducts{build_factorize, build_expand, build_resample, build_lobes};

std::vector<Kernel> lobe_kernels(const LobeSet& lobes, const std::string& variant,
                                 const std::vector<Builder>& builders) {
    std::vector<Kernel> kernels;
    for (const Builder build : builders) {
        kernels.push_back(graph::optimize(build(lobes)));
        kernels.back().variant = variant;
    }
    return kernels;
}

/// The products of the lobes, and `rotate_zhf` of those that turn.
std::vector<Kernel> lobe_kernels_and_turn(const LobeSet& lobes, const LobeSet& turned,
                                          const std::string& variant) {
    std::vector<Kernel> kernels = lobe_kernels(lobes, variant, kProducts);
    kernels.push_back(lobe_kernels(turned, variant, {build_rotate_zhf}).front());
    return kernels;
}

int instructions(const std::vector<Kernel>& kernels, const std::string& name) {
    const auto kernel = std::ranges::find(kernels, name, &Kernel::name);
    return graph::count_operations(*kernel).total().instructions();
}

/// The products of lobes of each band's own, where factorizing or resampling by them costs less than by
/// shared ones. Not `rotate_zhf`: where nothing is shared between bands, turning costs more.
std::vector<Kernel> per_band_kernels(const LobeSet& lobes, const std::vector<Kernel>& shared) {
    const std::vector<Kernel> own = lobe_kernels(lobes, "per_band", kProducts);
    const auto costs_less = [&](const char* name) {
        return instructions(own, name) < instructions(shared, name);
    };
    return costs_less("factorize") || costs_less("resample") ? own : std::vector<Kernel>{};
}

}  // namespace

std::vector<Kernel> build_order(int order, const OrderPlans& plans, const OrderLobeSets& lobes) {
    std::vector<Kernel> kernels = build_rotations(order, plans);
    const auto append = [&](const std::vector<Kernel>& more) {
        kernels.insert(kernels.end(), more.begin(), more.end());
    };
    if (lobes.shared) {
        const LobeSet& turned = lobes.turned ? *lobes.turned : *lobes.shared;
        std::vector<Kernel> shared = lobe_kernels_and_turn(*lobes.shared, turned, "");
        for (Kernel& kernel : shared) kernel.needs_lobes = true;
        append(shared);
        if (lobes.per_band) append(per_band_kernels(*lobes.per_band, shared));
    }
    if (order >= kSmallestLobeOrder) {
        const LobeSet ring = LobeSet::ring(order);
        append(lobe_kernels_and_turn(ring, ring, "stable"));
    }
    return kernels;
}

}  // namespace zonal::kernels
