// Measures the error bounds that banners publish, and writes them to generator/bounds/bounds.json.
//
// Kernels run from their graphs, in each arithmetic that printed code meets: with fused instructions, with
// products and sums rounded apart, and as inexact as shader languages allow. Four steps a kernel:
//   excess  what |R R^T - I|_F adds: random matrices orthonormal only to 1e-3 and 1e-5 and those of the noisy
//           problems, in double, where rounding is nothing beside that; per band the largest singular value
//           of the error matrix is the worst over all signals.
//   signals for every other rotation (random and hard ones) the error matrix again, in the type that is
//           judged (for shaders: with each of fused and apart); its leading right singular vector is a signal
//           that the kernel turns as badly as any.
//   bound   the largest error with such signals and with random ones, less the excess, times a margin.
//   turns   the largest errors of rounding are rare: hundreds of thousands of random turns in float, band by
//           band, judged by the accurate kernel in double. Where they need it, the bound is raised, that in
//           double in the ratio of the two units of rounding. No other arithmetic has a lower bound than
//           fused instructions.
#include <fmt/format.h>
#include <tbb/parallel_for_each.h>

#include <cmath>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

#include "bounds/body_hash.hpp"
#include "bounds/published.hpp"
#include "graph/counts.hpp"
#include "io/output_file.hpp"
#include "kernels/order_kernels.hpp"
#include "program/numbers.hpp"
#include "program/program.hpp"
#include "support/arithmetic.hpp"
#include "support/graph_kernels.hpp"
#include "support/many_turns.hpp"
#include "support/worst_signal.hpp"

namespace zonal {
namespace {

/// Over the largest error met: rotations and roundings that were not tried.
constexpr double kMargin = 1.5;
constexpr double kExcessMargin = 1.1;

/// Operations of all random turns of an order: some ten seconds.
constexpr double kOperationsOfTurns = 2e9;

/// Of the problems with random rotations one in so many.
constexpr int kThinning = 30;

struct Options {
    int rotations = 0;
    std::uint64_t seed = 1;
    std::vector<int> orders;
    std::vector<std::string> kernels;
    bool only_turns = false;
    bool only_missing = false;
    std::string out;
};

using oracle::Real;

oracle::Matrix3 widened(const double* r) {
    oracle::Matrix3 matrix;
    std::copy(r, r + 9, matrix.begin());
    return matrix;
}

/// Rotations that are meant not to be orthonormal: random ones, and those of the problems in both types,
/// whose error would otherwise be taken for one of rounding.
std::vector<oracle::Matrix3> noisy_rotations(int order, const Options& options) {
    std::vector<oracle::Matrix3> rotations;
    std::mt19937_64 random(options.seed);
    for (int k = 0; k < 2 * options.rotations; ++k) {
        const double noise = k % 2 == 0 ? 1e-3 : 1e-5;  // at high orders 1e-3 costs more than in proportion
        rotations.push_back(widened(cases::with_noise(cases::random_rotation(random), noise, random).data()));
    }
    const auto add_problems = [&](auto zero) {
        using T = decltype(zero);
        for (const auto& problem : accuracy::problems<T>(order, options.rotations, kThinning, options.seed)) {
            if (!problem.is_noisy) continue;
            oracle::Matrix3 given;
            std::transform(problem.rotation.begin(), problem.rotation.end(), given.begin(),
                           [](double entry) { return static_cast<T>(entry); });
            rotations.push_back(given);
        }
    };
    add_problems(0.0);
    add_problems(0.0f);
    return rotations;
}

/// What |R R^T - I|_F costs each kernel at the most, and at least what the project's contract grants.
std::map<std::string, double> measure_excess(const OrderKernels& order, const Options& options) {
    const auto kernels = graph_contestants<double>(order.order, order.kernels, {});
    const oracle::Rotation exact(order.order);
    std::map<std::string, double> excess;
    for (const auto& kernel : kernels) excess[kernel.name] = (order.order - 1) / 2.0;
    for (const oracle::Matrix3& given : noisy_rotations(order.order, options)) {
        const auto blocks = exact.blocks(given);
        const double defect = static_cast<double>(oracle::orthonormality_error(given));
        double r[9];
        std::transform(given.begin(), given.end(), r,
                       [](const Real& entry) { return static_cast<double>(entry); });
        for (const auto& kernel : kernels) {
            const double gain = worst_signal(order.order, blocks, r, kernel).gain / defect;
            excess[kernel.name] = std::max(excess[kernel.name], kExcessMargin * gain);
        }
    }
    for (auto& [name, value] : excess) value = std::ceil(value * 100) / 100;
    return excess;
}

const std::string kApart = " apart", kAllowed = " as shaders may";

bool has_quotient_or_root(const graph::Kernel& kernel) {
    return graph::count_operations(kernel).total().other > 0;
}

/// Every kernel in the arithmetics of T, their names behind its own.
template <class T>
std::vector<accuracy::Contestant<T>> in_all_arithmetics(const OrderKernels& order,
                                                        const std::map<std::string, double>& excess) {
    std::vector<accuracy::Contestant<T>> all;
    const auto add = [&](const std::string& suffix, std::vector<accuracy::Contestant<T>> contestants) {
        for (auto& contestant : contestants) {
            contestant.name += suffix;
            all.push_back(std::move(contestant));
        }
    };
    using arithmetic::Allowed, arithmetic::Apart;
    add("", graph_contestants<T>(order.order, order.kernels, excess));
    add(kApart, graph_contestants<T, Apart>(order.order, order.kernels, excess));
    if constexpr (std::is_same_v<T, float>) {
        // Without quotients and roots they do what fused and apart do.
        std::set<std::string> inexact;
        for (const graph::Kernel& kernel : order.kernels)
            if (has_quotient_or_root(kernel))
                inexact.insert(kernel.name == "prepare" ? "apply" : kernel.full_name());
        const auto add_allowed = [&](const std::string& base,
                                     std::vector<accuracy::Contestant<T>> contestants) {
            std::erase_if(contestants, [&](const auto& some) { return !inexact.contains(some.name); });
            add(kAllowed + base, std::move(contestants));
        };
        add_allowed(", fused",
                    graph_contestants<T, Allowed<graph::Fused>>(order.order, order.kernels, excess));
        add_allowed(", apart", graph_contestants<T, Allowed<Apart>>(order.order, order.kernels, excess));
    }
    return all;
}

template <class T>
std::map<std::string, double> measure_bounds(const OrderKernels& order,
                                             const std::map<std::string, double>& excess,
                                             const Options& options) {
    const auto kernels = in_all_arithmetics<T>(order, excess);
    const oracle::Rotation exact(order.order);
    std::vector<accuracy::Problem> problems =
        accuracy::problems<T>(order.order, options.rotations, kThinning, options.seed);
    std::map<std::string, double> bounds;
    const auto note = [&](const std::vector<accuracy::Problem>& some) {
        const auto worst = accuracy::worst_errors<T>(exact, some, kernels);
        for (std::size_t k = 0; k < kernels.size(); ++k)
            bounds[kernels[k].name] = std::max(bounds[kernels[k].name], kMargin * worst[k].error);
    };
    note(problems);
    std::erase_if(problems, [](const accuracy::Problem& problem) { return problem.has_hard_signal; });
    const std::size_t step = order.order <= 10 ? 1 : 4;  // the time of one grows as order^4
    for (std::size_t at = 0; at < problems.size(); at += step) {
        const accuracy::Problem& problem = problems[at];
        T r[9];
        std::copy(problem.rotation.begin(), problem.rotation.end(), r);
        oracle::Matrix3 given;
        std::copy(r, r + 9, given.begin());
        const auto blocks = exact.blocks(given);
        std::vector<accuracy::Problem> worst;
        for (const auto& kernel : kernels)
            worst.push_back({problem.name, problem.rotation,
                             worst_signal(order.order, blocks, r, kernel).signal, problem.is_noisy, false});
        note(worst);
    }
    return bounds;
}

/// The largest error of a band over as many random turns as some seconds allow.
std::map<std::string, double> worst_of_turns(const OrderKernels& order, const std::vector<graph::Kernel>& all,
                                             const std::map<std::string, double>& excess,
                                             const Options& options) {
    const auto accurate = std::ranges::find(all, "rotate_accurate", &graph::Kernel::name);
    const auto judge = graph_contestants<double>(order.order, {*accurate}, {}).front();
    double operations = 0;
    for (const graph::Kernel& kernel : order.kernels) operations += kernel.graph.size();
    return accuracy::worst_of_many_turns(
        order.order, graph_contestants<float>(order.order, order.kernels, excess), judge,
        static_cast<std::int64_t>(kOperationsOfTurns / operations), options.seed);
}

void raise(std::string& bound, double least) {
    if (std::stod(bound) < least) bound = rounded_up(least);
}

void raise_to_fused(Bound& bound) {
    raise(bound.float_apart, std::stod(bound.float_text));
    raise(bound.double_apart, std::stod(bound.double_text));
    raise(bound.shader, std::stod(bound.float_apart));
}

/// The kernels to measure, with `prepare`, which `apply` needs.
std::vector<graph::Kernel> chosen_kernels(std::vector<graph::Kernel> kernels, const Options& options) {
    if (options.kernels.empty()) return kernels;
    std::erase_if(kernels, [&](const graph::Kernel& kernel) {
        return kernel.name != "prepare" &&
               std::ranges::find(options.kernels, kernel.full_name()) == options.kernels.end();
    });
    return kernels;
}

/// Raises a bound to what random turns need.
void raise_by_turns(std::vector<MeasuredBound>& entries, const OrderKernels& order,
                    const std::vector<graph::Kernel>& all, const Options& options) {
    std::map<std::string, double> excess;
    for (const MeasuredBound& entry : entries)
        excess[entry.kernels.front()] = std::stod(entry.bound.excess_text);
    const auto worst = worst_of_turns(order, all, excess, options);
    constexpr double kUnits = 0x1p-53 / 0x1p-24;
    for (MeasuredBound& entry : entries) {
        if (!worst.contains(entry.kernels.front())) continue;
        const double bound = kMargin * worst.at(entry.kernels.front());
        raise(entry.bound.float_text, bound);
        raise(entry.bound.double_text, bound * kUnits);
        raise_to_fused(entry.bound);
    }
}

nlohmann::ordered_json entry_of(const MeasuredBound& measured) {
    const Bound& bound = measured.bound;
    return {{"order", measured.order},
            {"body", measured.body},
            {"kernels", measured.kernels},
            {"float", bound.float_text},
            {"double", bound.double_text},
            {"float_apart", bound.float_apart},
            {"double_apart", bound.double_apart},
            {"shader", bound.shader},
            {"excess", bound.excess_text}};
}

/// Each kernel's body once, by the first that has it.
std::vector<MeasuredBound> bodies_of(const OrderKernels& order) {
    std::vector<MeasuredBound> bodies;
    for (const graph::Kernel& kernel : order.kernels) {
        if (!kernel.has_bound) continue;
        const std::string body = body_hash(kernel, order.kernels);
        const auto known = std::ranges::find(bodies, body, &MeasuredBound::body);
        if (known == bodies.end())
            bodies.push_back({order.order, body, {kernel.full_name()}, {}});
        else
            known->kernels.push_back(kernel.full_name());
    }
    return bodies;
}

std::vector<MeasuredBound> measure_order(const OrderKernels& whole, const Options& options) {
    OrderKernels order = whole;
    order.kernels = chosen_kernels(whole.kernels, options);
    const auto excess = measure_excess(order, options);
    const auto single = measure_bounds<float>(order, excess, options);
    const auto twice = measure_bounds<double>(order, excess, options);
    const auto allowed = [&](const std::string& name) {
        double most = std::max(single.at(name), single.at(name + kApart));
        for (const char* base : {", fused", ", apart"})
            if (single.contains(name + kAllowed + base))
                most = std::max(most, single.at(name + kAllowed + base));
        return most;
    };
    std::vector<MeasuredBound> entries = bodies_of(order);
    for (MeasuredBound& entry : entries) {
        const std::string& name = entry.kernels.front();
        entry.bound = {.float_text = rounded_up(single.at(name)),
                       .double_text = rounded_up(twice.at(name)),
                       .float_apart = rounded_up(single.at(name + kApart)),
                       .double_apart = rounded_up(twice.at(name + kApart)),
                       .shader = rounded_up(allowed(name)),
                       .excess_text = fmt::format("{:.2f}", excess.at(name))};
        raise_to_fused(entry.bound);
    }
    raise_by_turns(entries, order, whole.kernels, options);
    return entries;
}

/// Few rotations are tried at high orders, and rare errors are missed: from order 11 on no bound of a kernel
/// without a lobe table is below that of the order before.
void raise_to_lower_orders(std::map<int, std::vector<MeasuredBound>>& measured) {
    constexpr int kFirst = 11;
    for (auto& [n, entries] : measured) {
        if (n < kFirst || !measured.contains(n - 1)) continue;
        for (MeasuredBound& entry : entries) {
            for (const MeasuredBound& lower : measured.at(n - 1)) {
                const std::string& name = entry.kernels.front();
                if (lower.kernels.front() != name || name.ends_with("rotate_zhf")) continue;
                raise(entry.bound.float_text, std::stod(lower.bound.float_text));
                raise(entry.bound.double_text, std::stod(lower.bound.double_text));
                raise_to_fused(entry.bound);
            }
        }
    }
}

/// An order's entries of the file that still are of one of its bodies, and whose kernels are not measured
/// anew.
std::vector<MeasuredBound> kept_of(const OrderKernels& order, const std::vector<MeasuredBound>& known) {
    std::vector<MeasuredBound> kept;
    for (const MeasuredBound& body : bodies_of(order)) {
        const auto entry = std::ranges::find_if(known, [&](const MeasuredBound& some) {
            return some.order == order.order && some.body == body.body;
        });
        if (entry != known.end()) kept.push_back({body.order, body.body, body.kernels, entry->bound});
    }
    return kept;
}

/// Puts new entries in the place of those of the same body.
std::vector<MeasuredBound> merged(const OrderKernels& order, const std::vector<MeasuredBound>& kept,
                                  const std::vector<MeasuredBound>& measured) {
    std::vector<MeasuredBound> all = measured;
    all.insert(all.end(), kept.begin(), kept.end());
    return kept_of(order, all);
}

/// The options of an order: what of it is missing where only that is wanted.
Options options_of(const OrderKernels& order, const std::vector<MeasuredBound>& kept, Options options) {
    const int n = order.order;
    // As many rotations as cost about the same at every order, if not told otherwise.
    if (options.rotations == 0) options.rotations = n <= 2 ? 10000 : n <= 6 ? 500 : n <= 10 ? 150 : 40;
    if (!options.only_missing) return options;
    for (const MeasuredBound& body : bodies_of(order))
        if (std::ranges::find(kept, body.body, &MeasuredBound::body) == kept.end())
            options.kernels.push_back(body.kernels.front());
    return options;
}

void run(const Options& options) {
    check_is_writable("--out", options.out);
    std::vector<int> orders = options.orders;
    if (orders.empty())
        for (int n = kLargestOrder; n >= kSmallestOrder; --n) orders.push_back(n);
    std::vector<MeasuredBound> known;
    if (std::filesystem::exists(options.out)) known = read_bounds(options.out);
    std::map<int, std::vector<MeasuredBound>> measured;
    for (const MeasuredBound& bound : known) measured[bound.order].push_back(bound);
    std::mutex mutex;
    tbb::parallel_for_each(orders, [&](int n) {
        const OrderKernels order = build_order_kernels(n, {});
        std::vector<MeasuredBound> entries = kept_of(order, known);
        const Options of_order = options_of(order, entries, options);
        if (options.only_turns)
            raise_by_turns(entries, order, order.kernels, of_order);
        else if (!options.only_missing || !of_order.kernels.empty())
            entries = merged(order, entries, measure_order(order, of_order));
        const std::lock_guard lock(mutex);
        for (const MeasuredBound& entry : entries) fmt::print("{}\n", entry_of(entry).dump());
        std::fflush(stdout);
        measured[n] = std::move(entries);
    });
    raise_to_lower_orders(measured);
    nlohmann::ordered_json bounds = nlohmann::ordered_json::array();
    for (const auto& [n, entries] : measured)
        for (const MeasuredBound& entry : entries) bounds.push_back(entry_of(entry));
    const std::string command = fmt::format(
        "zonal-measure-bounds{} --seed {} --out generator/bounds/bounds.json",
        options.rotations == 0 ? "" : fmt::format(" --rotations {}", options.rotations), options.seed);
    write_file_atomically(
        options.out,
        nlohmann::ordered_json{{"command", command}, {"margin", kMargin}, {"bounds", bounds}}.dump(2) + "\n");
}

}  // namespace
}  // namespace zonal

int main(int argc, char** argv) {
    CLI::App app{"Measures the error bounds that generated banners publish."};
    zonal::Options options;
    namespace program = zonal::program;
    program::add_number(
        app, "--rotations", options.rotations, program::from_to(1, 1000000),
        "random rotations of each order and type (default: 10000 at order 2, 500 to 6, 150 to 10, 40 above)");
    program::add_numbers(app, "--orders", options.orders,
                         program::from_to(zonal::kSmallestOrder, zonal::kLargestOrder),
                         "to measure anew in the file that --out names (default: all)");
    app.add_option("--kernels", options.kernels, "to measure anew, as banners call them (default: all)");
    app.add_flag(
        "--only-turns", options.only_turns,
        "many random turns alone: raises what the file says where they need it, for kernels that did "
        "not change");
    app.add_flag("--missing", options.only_missing,
                 "kernels alone of whose bodies the file that --out names has no bound");
    program::add_number(app, "--seed", options.seed, {}, "of all random rotations and signals")
        ->capture_default_str();
    app.add_option("--out", options.out, "the file to write")->check(program::not_empty())->required();
    return program::run(app, argc, argv, [&] { zonal::run(options); });
}
