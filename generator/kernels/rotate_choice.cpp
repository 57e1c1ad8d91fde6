#include "kernels/rotate_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "graph/call_time.hpp"
#include "graph/counts.hpp"

namespace zonal::kernels {

namespace {

using graph::Kernel;

constexpr double kOfLeastError = 5, kOfContract = 2, kSameTime = 1.1;

/// What the contract asks of `rotate` at some orders; between them, in proportion.
ErrorBounds contract(int order) {
    struct Point {
        int order;
        ErrorBounds bounds;
    };
    static const std::vector<Point> points{{2, {1.2e-7, 3e-16}},   {3, {2.8e-7, 6e-16}}, {4, {8e-7, 1.5e-15}},
                                           {5, {1.3e-6, 3.5e-15}}, {6, {1.8e-6, 5e-15}}, {8, {2e-6, 7e-15}},
                                           {10, {2.5e-6, 8e-15}},  {20, {5e-6, 3e-14}}};
    const auto above = std::ranges::find_if(points, [&](const Point& p) { return p.order >= order; });
    if (above == points.end()) throw std::logic_error(fmt::format("no contract for order {}", order));
    if (above == points.begin()) return above->bounds;
    const Point& a = *(above - 1);
    const Point& b = *above;
    const double t = static_cast<double>(order - a.order) / (b.order - a.order);
    return {a.bounds.in_float + t * (b.bounds.in_float - a.bounds.in_float),
            a.bounds.in_double + t * (b.bounds.in_double - a.bounds.in_double)};
}

const ErrorBounds& bounds_of(const std::map<std::string, ErrorBounds>& bounds, const std::string& kernel) {
    const auto found = bounds.find(kernel);
    if (found == bounds.end()) throw std::logic_error("no bound of " + kernel);
    return found->second;
}

bool is_within(const ErrorBounds& some, const ErrorBounds& others, double times) {
    return some.in_float <= times * others.in_float && some.in_double <= times * others.in_double;
}

std::string fastest(const std::vector<std::string>& names, int channels, int order,
                    const std::vector<Kernel>& kernels, const std::map<std::string, ErrorBounds>& bounds,
                    Processor processor) {
    struct Candidate {
        std::string name;
        double time;
        ErrorBounds bounds;
    };
    std::vector<Candidate> candidates;
    for (const std::string& name : names) {
        const auto kernel = std::ranges::find(kernels, name, &Kernel::full_name);
        if (kernel == kernels.end() || !kernel->forwards_to.empty()) continue;
        const ErrorBounds& own = bounds_of(bounds, name);
        if (is_within(own, bounds_of(bounds, "rotate_accurate"), kOfLeastError) &&
            is_within(own, contract(order), kOfContract))
            candidates.push_back({name, call_time(*kernel, channels, processor), own});
    }
    if (candidates.empty()) return "rotate_accurate";  // the best there is
    const double least = std::ranges::min(candidates, {}, &Candidate::time).time;
    std::erase_if(candidates, [&](const Candidate& some) { return some.time > kSameTime * least; });
    return std::ranges::min(candidates, {}, [](const Candidate& some) { return some.bounds.in_float; }).name;
}

}  // namespace

double call_time(const Kernel& kernel, int channels, Processor processor) {
    if (processor == Processor::cpu) return graph::call_cycles(kernel, channels);
    constexpr int kRoot = 4;  // reciprocals and roots run at a quarter of the rate
    const auto weigh = [](const graph::Counts& c) { return c.mul + c.add + c.fma + kRoot * c.other; };
    const graph::Cost cost = graph::count_operations(kernel);
    return weigh(cost.per_rotation) + channels * weigh(cost.per_vector);
}

RotateChoice choose_rotate(int order, const std::vector<Kernel>& kernels,
                           const std::map<std::string, ErrorBounds>& bounds, Processor processor) {
    const auto choose = [&](const std::vector<std::string>& names, int channels) {
        return fastest(names, channels, order, kernels, bounds, processor);
    };
    // A kernel that gives several channels to another one is no candidate for them.
    std::vector<std::string> for_channels{"rotate_channels", "rotate_tensor", "rotate_accurate"};
    if (graph::kernel_named(kernels, "rotate_fewest").for_channels.empty())
        for_channels.emplace_back("rotate_fewest");
    return {choose({"rotate_fewest", "rotate_tensor", "rotate_accurate"}, 1), choose(for_channels, 3)};
}

Kernel make_rotate(const std::vector<Kernel>& kernels, const RotateChoice& choice) {
    const Kernel& one = graph::kernel_named(kernels, choice.one);
    const Kernel& channels = graph::kernel_named(kernels, choice.channels);
    Kernel rotate = one;
    rotate.name = "rotate";
    rotate.forwards_to = choice.one;
    rotate.for_channels = choice.channels == choice.one ? "" : choice.channels;
    rotate.needs_proper_rotation = one.needs_proper_rotation || channels.needs_proper_rotation;
    const auto details = rotate.summary.find('\n');
    rotate.summary = fmt::format(
        "What to call: the fastest exact rotation with at most five times the least error,\n{}.{}",
        choice.one, rotate.summary.substr(details));
    return rotate;
}

}  // namespace zonal::kernels
