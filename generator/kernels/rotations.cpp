#include "kernels/rotations.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "graph/passes.hpp"
#include "kernels/band_methods.hpp"
#include "kernels/contraction.hpp"
#include "kernels/dense_blocks.hpp"
#include "kernels/dense_recursion.hpp"
#include "kernels/planner.hpp"

namespace zonal::kernels {

namespace {

using graph::Kernel;
using graph::Kind;
using graph::Value;

const char* const kTurnsTheFunction = "Rotates the function, not the frame: f'(w) = f(R^T w).";
std::vector<std::string> sources_of(const Plan& plan) {
    std::vector<std::string> sources;
    for (const BandMethod* method : plan)
        if (std::ranges::find(sources, method->source) == sources.end()) sources.push_back(method->source);
    return sources;
}

Kernel planned(const std::string& name, const std::string& purpose, int order, const Plan& plan) {
    Kernel kernel = build_plan(order, plan);
    kernel.name = name;
    kernel.summary =
        fmt::format("{}\n{}\nBands are independent: a NaN stays in its band.", purpose, kTurnsTheFunction);
    kernel.sources = sources_of(plan);
    kernel.has_bound = true;
    return kernel;
}

/// Straight lines of dense blocks take g++ 12 (-O2) 1, 3, 14, 49 and 140 s at orders 8, 10, 12, 16 and 20.
constexpr int kLastStraightDenseOrder = 10;

Kernel build_blocks(int order) {
    Kernel kernel;
    kernel.name = "blocks";
    kernel.summary =
        "The dense matrix of every band, for many vectors of one rotation: f'_l = dense_l f_l.\n"
        "Rotates the function, not the frame.";
    kernel.sources = {band_method("dense").source};
    kernel.inputs = {rotation_array()};
    kernel.output = {"dense", Kind::rotation, order * (4 * order * order - 1) / 3,
                     "row-major (2l+1) x (2l+1) for l = 0, 1, ..."};
    kernel.has_bound = true;
    const auto all = dense_blocks(kernel, rotation_rows(kernel), order);
    int index = 0;
    // A step is a column and its mirror image: made of that column of the band before, or of those beside it.
    for (int l = 0; l < order; ++l)
        for (int k = 0; k < static_cast<int>(all[l].size()); ++k)
            kernel.store(index++, all[l][k], l, std::abs(k % (2 * l + 1) - l));
    if (order > kLastStraightDenseOrder) kernel.loops = loops_of_blocks(order);
    return graph::optimize(std::move(kernel));
}

bool is_same_work(const Kernel& a, const Kernel& b) {
    const auto weight_of = [](const Kernel& kernel, int vectors) { return weight(kernel, {vectors, false}); };
    return weight_of(a, 0) == weight_of(b, 0) && weight_of(a, 1) == weight_of(b, 1);
}

}  // namespace

OrderPlans plan_order(int order) {
    constexpr int kMany = 64;
    // Up to order 3 mirrors cost one channel nothing and three a few instructions: every form takes them, so
    // that what holds for one V holds for all.
    const bool takes_mirrors = order <= 3;
    Planner planner(order);
    return {planner.cheapest({1, takes_mirrors}), planner.cheapest({3, takes_mirrors}),
            planner.cheapest({kMany, takes_mirrors})};
}

std::vector<Kernel> build_rotations(int order, const OrderPlans& plans) {
    Kernel fewest = planned("rotate_fewest", "The exact rotation of one vector by the fewest instructions.",
                            order, plans.one);
    Kernel channels =
        planned("rotate_channels", "The exact rotation of three vectors at once by the fewest instructions.",
                order, plans.channels);
    channels.is_for_channels = true;
    graph::Halves halves = graph::split_by_kind(planned("apply", "", order, plans.many));
    halves.prepare.name = "prepare";
    halves.prepare.summary =
        "What `apply` needs to know of a rotation: prepare once, apply to many vectors.\n"
        "Rotates the function, not the frame.";
    halves.prepare.output.name = "scalars";
    halves.prepare.output.comment = "for `apply`";
    halves.prepare.has_bound = false;
    halves.apply.summary =
        "Rotates a vector by what `prepare` made of the rotation: the cheapest for many vectors.\n"
        "Bands are independent: a NaN stays in its band.";
    halves.apply.inputs[0].name = "scalars";
    halves.apply.inputs[0].comment = "by `prepare`";

    // Where a contraction knows every band, it needs about half the instructions of dense blocks.
    const bool is_contracted = order - 1 <= kLargestContractionBand;
    const Plan contracted(order - 1, &band_method("contraction"));
    Plan accurate(order - 1, &band_method(is_contracted ? "contraction, read directly" : "dense"));
    accurate[0] = contracted[0];
    std::vector<Kernel> kernels;
    if (!is_same_work(fewest, channels)) {
        fewest.for_channels = channels.name;
        kernels.push_back(channels);
    }
    if (is_contracted) {
        kernels.push_back(planned(
            "rotate_tensor",
            "The exact rotation by products and sums alone, mirrors included: no division, root or pole.",
            order, contracted));
        if (plans.one == contracted) fewest.forwards_to = kernels.back().name;
    }
    kernels.push_back(fewest);
    kernels.push_back(halves.prepare);
    kernels.push_back(halves.apply);
    kernels.push_back(
        planned("rotate_accurate", "The most accurate exact rotation, mirrors included.", order, accurate));
    if (order > kLastStraightDenseOrder) kernels.back().loops = loops_of_rotation(order);
    kernels.push_back(build_blocks(order));
    return kernels;
}

}  // namespace zonal::kernels
