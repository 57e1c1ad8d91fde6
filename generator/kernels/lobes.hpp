#pragma once

#include <vector>

#include "graph/counts.hpp"
#include "graph/kernel.hpp"
#include "lobes/lobe_table.hpp"

namespace zonal::kernels {

/// The lobes of an order: directions at 50 digits and the exact factorization of every band by some of them.
struct LobeSet {
    int order = 0;
    /// Every band uses all lobes: more than its 2l+1 coefficients, so that its weights lie elsewhere.
    bool is_ring = false;
    std::vector<exact::Direction<exact::Real>> directions;  ///< unit
    std::vector<std::vector<int>> lobes_of;                 ///< of bands 0 … order-1: which directions
    std::vector<BandFactorization> bands;                   ///< 0 … order-1

    /// Those of an order's table: 2*order-1 directions; band l uses the first 2l+1. Source: section 6 of the
    /// paper.
    static LobeSet shared(const LobeTable& table);

    /// One ring of 2*order-1 lobes that every band uses, all of them: cond_2 at most 10 up to order 20.
    static LobeSet ring(int order);

    /// Lobes of their own for every band, 2l+1 for band l: the pole, the axes, and those of the tables of
    /// bands 2, 3, … Source: section 5.
    static LobeSet per_band(const std::vector<const LobeTable*>& tables);

    /// Where the weights of band l begin among those of all bands; for l = order, how many there are.
    int weight_start(int l) const;
};

/// Operations of the band's sparse product Âᵀ f as it is emitted, counted on its graph.
graph::Counts factorization_counts(const BandFactorization& band);

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
