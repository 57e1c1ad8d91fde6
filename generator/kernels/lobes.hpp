#pragma once

#include <vector>

#include "exact/factorization.hpp"
#include "graph/kernel.hpp"

namespace zonal::kernels {

/// The shared lobes of an order: directions at 50 digits and the exact factorization of every band by them.
struct LobeSet {
    int order = 0;
    std::vector<exact::Direction<exact::Real>> directions;  ///< 2*order-1, unit
    std::vector<exact::BandFactorization> bands;            ///< 0 … order-1
};

/// Multiplications of the band's sparse product Âᵀ f as it is emitted, counted on its graph.
int factorization_multiplications(const exact::BandFactorization& band);

/// ẑ = Âᵀ f, per band.
graph::Kernel build_factorize(const LobeSet& lobes);
/// f = Yᵀ ẑ, per band.
graph::Kernel build_expand(const LobeSet& lobes);
/// f'_l = Â_l · (samples of band l at the inversely rotated lobes).
graph::Kernel build_resample(const LobeSet& lobes);
/// R ω_d for every lobe.
graph::Kernel build_lobes(const LobeSet& lobes);
/// f' = (Yᴿ)ᵀ Âᵀ f.
graph::Kernel build_rotate_zhf(const LobeSet& lobes);

}  // namespace zonal::kernels
