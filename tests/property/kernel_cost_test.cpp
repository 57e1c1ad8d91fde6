// What a counting type sees of every order's kernels: what their banners say, and the project's goals.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "support/banner.hpp"
#include "support/compiled_kernels.hpp"

namespace zonal {
namespace {

std::string text_of(const Tally& tally) {
    return fmt::format("{} mul {} add {} fma {} other", tally.mul, tally.add, tally.fma, tally.other);
}

struct Counts {
    const CompiledOrder& compiled;
    const int N = compiled.order;
    const RotateKernels<Counting>& kernels = compiled.counting;
    std::vector<Counting> r = std::vector(9, Counting(0.5)), in = std::vector(compiled.size(), Counting(1)),
                          out = std::vector(compiled.size(), Counting(0));

    /// What the counting type sees for one vector is the banner's first part.
    template <class Run>
    void expect_banner(const std::string& kernel, Run run) {
        Counting::tally = {};
        run();
        EXPECT_EQ(text_of(Counting::tally), banner::cost(N, kernel).one) << kernel;
    }

    void banners_tell_what_a_counting_type_sees() {
        std::vector<Counting> dense(compiled.blocks_size(), Counting(0)),
            scalars(compiled.scalars, Counting(0));
        expect_banner("rotate", [&] { kernels.rotate(r.data(), in.data(), out.data()); });
        expect_banner("rotate_fewest", [&] { kernels.rotate_fewest(r.data(), in.data(), out.data()); });
        expect_banner("prepare", [&] { kernels.prepare(r.data(), scalars.data()); });
        expect_banner("apply", [&] { kernels.apply(scalars.data(), in.data(), out.data()); });
        expect_banner("rotate_accurate", [&] { kernels.rotate_accurate(r.data(), in.data(), out.data()); });
        expect_banner("blocks", [&] { kernels.blocks(r.data(), dense.data()); });
    }

    void a_further_vector_costs_what_the_banner_says() {
        std::vector<CountingSignal> f(N * N), result(N * N);
        std::vector<double> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
        CountingSignal::tally = {};
        compiled.rotate_counting_signal(rotation.data(), f.data(), result.data());
        const std::string kernel = N <= 3 ? "rotate" : "rotate_channels";
        EXPECT_EQ(text_of(CountingSignal::tally), banner::cost(N, kernel).further);
    }

    /// The numbers the project set itself: multiplications (mul + fma) and instructions of one vector,
    /// instructions of three channels that share a rotation.
    void the_fewest_instructions_are_no_more_than_their_goal() {
        struct Goal {
            int multiplications, instructions, rgb_instructions;
        };
        const std::map<int, Goal> goals{{3, {43, 44, 132}},   {4, {112, 118, 284}}, {5, {193, 201, 509}},
                                        {6, {303, 311, 812}}, {7, {475, 0, 0}},     {8, {665, 0, 0}},
                                        {9, {905, 0, 0}},     {10, {1200, 0, 0}}};
        if (!goals.contains(N)) return;
        const Goal goal = goals.at(N);
        Counting::tally = {};
        kernels.rotate_fewest(r.data(), in.data(), out.data());
        EXPECT_LE(Counting::tally.mul + Counting::tally.fma, goal.multiplications);
        if (goal.instructions == 0) return;
        EXPECT_LE(instructions(Counting::tally), goal.instructions);
        std::vector<CountingRgb> rgb(N * N), turned(N * N);
        Counting::tally = {};
        compiled.rotate_counting_rgb(r.data(), rgb.data(), turned.data());
        EXPECT_LE(instructions(Counting::tally), goal.rgb_instructions);
    }

    static int instructions(const Tally& t) { return t.mul + t.add + t.fma + t.other; }
};

struct TensorCounts : Counts {
    void run() { kernels.rotate_tensor(r.data(), in.data(), out.data()); }

    void the_banner_tells_what_a_counting_type_sees() {
        expect_banner("rotate_tensor", [&] { run(); });
    }

    void it_neither_divides_nor_takes_a_root() {
        Counting::tally = {};
        run();
        EXPECT_GT(Counting::tally.fma, 0);
        EXPECT_EQ(Counting::tally.other, 0);
    }

    void a_further_vector_costs_what_the_banner_says() {
        std::vector<CountingSignal> f(N * N), result(N * N);
        const std::vector<double> rotation{1, 0, 0, 0, 1, 0, 0, 0, 1};
        CountingSignal::tally = {};
        compiled.rotate_tensor_counting_signal(rotation.data(), f.data(), result.data());
        EXPECT_EQ(text_of(CountingSignal::tally), banner::cost(N, "rotate_tensor").further);
    }
};

struct LobeCounts {
    const LobeVariant& variant;
    const int N = variant.order;
    const LobeKernels<Counting>& kernels = variant.counting;
    std::vector<Counting> r = std::vector(9, Counting(0.5)), in = std::vector(variant.weights(), Counting(1)),
                          out = std::vector(variant.weights(), Counting(0));

    template <class Run>
    void expect_banner(const std::string& kernel, Run run) {
        Counting::tally = {};
        run();
        EXPECT_EQ(text_of(Counting::tally), banner::cost(N, variant.prefix + kernel).one) << kernel;
    }

    void banners_tell_what_a_counting_type_sees_in_products() {
        std::vector<Counting> directions(3 * variant.directions(), Counting(0));
        expect_banner("factorize", [&] { kernels.factorize(in.data(), out.data()); });
        expect_banner("expand", [&] { kernels.expand(in.data(), out.data()); });
        expect_banner("resample", [&] { kernels.resample(in.data(), out.data()); });
        expect_banner("lobes", [&] { kernels.lobes(r.data(), directions.data()); });
    }

    void banners_tell_what_a_counting_type_sees_in_rotate_zhf() {
        expect_banner("rotate_zhf", [&] { kernels.rotate_zhf(r.data(), in.data(), out.data()); });
    }

    /// Below the paper's Table II, standard algorithm on the CPU, although the turning of the lobes is
    /// counted.
    void rotate_zhf_multiplies_less_than_the_paper() {
        const std::map<int, int> paper{{3, 90},   {4, 275},  {5, 606},  {6, 1123},
                                       {7, 1891}, {8, 2930}, {9, 4297}, {10, 6046}};
        if (!paper.contains(N)) return;
        Counting::tally = {};
        kernels.rotate_zhf(r.data(), in.data(), out.data());
        EXPECT_LT(Counting::tally.mul + Counting::tally.fma, paper.at(N));
    }
};

#define ZONAL_TEST(suite, name)                                      \
    TEST(suite, name) {                                              \
        for (const CompiledOrder& compiled : compiled_orders()) {    \
            SCOPED_TRACE("order " + std::to_string(compiled.order)); \
            suite{compiled}.name();                                  \
        }                                                            \
    }
#define ZONAL_TENSOR_TEST(suite, name)                               \
    TEST(suite, name) {                                              \
        for (const CompiledOrder& compiled : orders_with_tensor()) { \
            SCOPED_TRACE("order " + std::to_string(compiled.order)); \
            suite{{compiled}}.name();                                \
        }                                                            \
    }
#define ZONAL_LOBE_TEST(suite, name, ...)                                                  \
    TEST(suite, name) {                                                                    \
        for (const LobeVariant& variant : lobes_of_all_orders({__VA_ARGS__})) {            \
            SCOPED_TRACE("order " + std::to_string(variant.order) + " " + variant.prefix); \
            LobeCounts{variant}.name();                                                    \
        }                                                                                  \
    }

using Layout = LobeVariant::Layout;

ZONAL_TEST(Counts, banners_tell_what_a_counting_type_sees)
ZONAL_TEST(Counts, a_further_vector_costs_what_the_banner_says)
ZONAL_TEST(Counts, the_fewest_instructions_are_no_more_than_their_goal)
ZONAL_TENSOR_TEST(TensorCounts, the_banner_tells_what_a_counting_type_sees)
ZONAL_TENSOR_TEST(TensorCounts, it_neither_divides_nor_takes_a_root)
ZONAL_TENSOR_TEST(TensorCounts, a_further_vector_costs_what_the_banner_says)
ZONAL_LOBE_TEST(LobeCounts, banners_tell_what_a_counting_type_sees_in_products, Layout::shared, Layout::ring)
ZONAL_LOBE_TEST(PerBandLobeCounts, banners_tell_what_a_counting_type_sees_in_products, Layout::per_band)
ZONAL_LOBE_TEST(LobeCounts, banners_tell_what_a_counting_type_sees_in_rotate_zhf, Layout::shared,
                Layout::ring)
ZONAL_LOBE_TEST(LobeCounts, rotate_zhf_multiplies_less_than_the_paper, Layout::shared)
#undef ZONAL_TEST
#undef ZONAL_TENSOR_TEST
#undef ZONAL_LOBE_TEST

}  // namespace
}  // namespace zonal
