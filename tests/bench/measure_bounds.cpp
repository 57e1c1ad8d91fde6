// Measures the error bounds that banners publish, and writes them to generator/tables/bounds.json.
//
// Kernels run from their graphs: the operations of the printed code with fused instructions. Four steps a
// kernel:
//   excess  what |R R^T - I|_F adds: random matrices orthonormal only to 1e-3 and 1e-5 and those of the noisy
//           problems, in double, where rounding is nothing beside that; per band the largest singular value
//           of the error matrix is the worst over all signals.
//   signals for every other rotation (random and hard ones) the error matrix again, in the type that is
//           judged; its leading right singular vector is a signal that the kernel turns as badly as any.
//   bound   the largest error with such signals and with random ones, less the excess, times a margin.
//   turns   the largest errors of rounding are rare: hundreds of thousands of random turns in float, band by
//           band, judged by the accurate kernel in double. Where they need it, the bound is raised, that in
//           double in the ratio of the two units of rounding.
#include <fmt/format.h>
#include <tbb/parallel_for_each.h>

#include <cmath>
#include <filesystem>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bounds/published.hpp"
#include "io/output_file.hpp"
#include "kernels/order_kernels.hpp"
#include "program/numbers.hpp"
#include "program/program.hpp"
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

template <class T>
std::map<std::string, double> measure_bounds(const OrderKernels& order,
                                             const std::map<std::string, double>& excess,
                                             const Options& options) {
    const auto kernels = graph_contestants<T>(order.order, order.kernels, excess);
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

/// Two digits, rounded up.
std::string rounded_up(double bound) {
    const double unit = std::pow(10.0, std::floor(std::log10(bound)) - 1);
    return fmt::format("{:.1e}", std::ceil(bound / unit) * unit);
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

/// Raises the bounds of an order's kernels to what random turns need.
void raise_by_turns(nlohmann::ordered_json& entries, const OrderKernels& order,
                    const std::vector<graph::Kernel>& all, const Options& options) {
    std::map<std::string, double> excess;
    for (const auto& entry : entries)
        excess[entry.at("kernel")] = std::stod(entry.at("excess").get<std::string>());
    const auto worst = worst_of_turns(order, all, excess, options);
    constexpr double kUnits = 0x1p-53 / 0x1p-24;
    for (auto& entry : entries) {
        if (!worst.contains(entry.at("kernel"))) continue;
        const double bound = kMargin * worst.at(entry.at("kernel"));
        const auto raise = [&](const char* type, double least) {
            if (std::stod(entry.at(type).get<std::string>()) < least) entry[type] = rounded_up(least);
        };
        raise("float", bound);
        raise("double", bound * kUnits);
    }
}

nlohmann::ordered_json entry_of(const std::string& kernel, int order, const std::string& table,
                                const emit::Bound& bound) {
    return {{"kernel", kernel},
            {"order", order},
            {"table", table},
            {"float", bound.float_text},
            {"double", bound.double_text},
            {"excess", bound.excess_text}};
}

nlohmann::ordered_json measure_order(int n, const Options& options) {
    OrderKernels order = build_order_kernels(n, {});
    const std::vector<graph::Kernel> all = order.kernels;
    order.kernels = chosen_kernels(std::move(order.kernels), options);
    const auto excess = measure_excess(order, options);
    const auto single = measure_bounds<float>(order, excess, options);
    const auto twice = measure_bounds<double>(order, excess, options);
    nlohmann::ordered_json entries = nlohmann::ordered_json::array();
    for (const graph::Kernel& kernel : order.kernels) {
        if (!kernel.has_bound) continue;
        const std::string table =
            kernel.needs_lobes ? order.tables.rotate_zhf->table.short_hash() : std::string{};
        const std::string name = kernel.full_name();
        entries.push_back(entry_of(name, n, table,
                                   {rounded_up(single.at(name)), rounded_up(twice.at(name)),
                                    fmt::format("{:.2f}", excess.at(name))}));
    }
    raise_by_turns(entries, order, all, options);
    return entries;
}

/// What the file says of an order, raised.
nlohmann::ordered_json raised_order(int n, nlohmann::ordered_json entries, const Options& options) {
    OrderKernels order = build_order_kernels(n, {});
    const std::vector<graph::Kernel> all = order.kernels;
    order.kernels = chosen_kernels(std::move(order.kernels), options);
    raise_by_turns(entries, order, all, options);
    return entries;
}

/// What the file says, if there is one, but for orders of which every kernel is measured anew.
std::map<int, nlohmann::ordered_json> kept_bounds(const Options& options, const std::vector<int>& orders) {
    std::map<int, nlohmann::ordered_json> kept;
    if (!std::filesystem::exists(options.out)) return kept;
    for (const MeasuredBound& bound : read_bounds(options.out)) {
        const bool is_measured = std::ranges::find(orders, bound.order) != orders.end();
        if (!is_measured || !options.kernels.empty() || options.only_turns)
            kept[bound.order].push_back(entry_of(bound.kernel, bound.order, bound.table, bound.bound));
    }
    return kept;
}

/// Puts an entry in the place of the kernel's old one, or at the end.
void put(nlohmann::ordered_json& entries, const nlohmann::ordered_json& entry) {
    const auto old = std::ranges::find_if(
        entries, [&](const auto& some) { return some.at("kernel") == entry.at("kernel"); });
    if (old == entries.end())
        entries.push_back(entry);
    else
        *old = entry;
}

/// Few rotations are tried at high orders, and rare errors are missed: from order 11 on no bound of a kernel
/// without a lobe table is below that of the order before.
void raise_to_lower_orders(std::map<int, nlohmann::ordered_json>& measured) {
    constexpr int kFirst = 11;
    for (auto& [n, entries] : measured) {
        if (n < kFirst || !measured.contains(n - 1)) continue;
        for (auto& entry : entries) {
            for (const auto& lower : measured.at(n - 1)) {
                if (lower.at("kernel") != entry.at("kernel") || entry.at("table") != "") continue;
                for (const char* type : {"float", "double"})
                    if (std::stod(lower.at(type).get<std::string>()) >
                        std::stod(entry.at(type).get<std::string>()))
                        entry[type] = lower.at(type);
            }
        }
    }
}

void run(const Options& options) {
    check_is_writable("--out", options.out);
    std::vector<int> orders = options.orders;
    std::map<int, nlohmann::ordered_json> measured;
    if (orders.empty())
        for (int n = kLargestOrder; n >= kSmallestOrder; --n) orders.push_back(n);
    if (!options.orders.empty() || !options.kernels.empty() || options.only_turns)
        measured = kept_bounds(options, orders);
    const auto known = measured;  // read by the threads that measure
    for (const int n : orders)
        if (options.only_turns && !known.contains(n))
            throw std::runtime_error(fmt::format(
                "{}: found no bounds of order {}, wanted what --only-turns raises; measure it first, "
                "without that option",
                options.out, n));
    std::mutex mutex;
    tbb::parallel_for_each(orders, [&](int n) {
        Options of_order = options;
        // As many rotations as cost about the same at every order, if not told otherwise.
        if (options.rotations == 0) of_order.rotations = n <= 2 ? 10000 : n <= 6 ? 500 : n <= 10 ? 150 : 40;
        const nlohmann::ordered_json entries =
            options.only_turns ? raised_order(n, known.at(n), of_order) : measure_order(n, of_order);
        const std::lock_guard lock(mutex);
        for (const auto& entry : entries) put(measured[n], entry);
        fmt::print("{}\n", entries.dump());
        std::fflush(stdout);
    });
    raise_to_lower_orders(measured);
    nlohmann::ordered_json bounds = nlohmann::ordered_json::array();
    for (const auto& [n, entries] : measured)
        for (const auto& entry : entries) bounds.push_back(entry);
    const std::string command = fmt::format(
        "zonal-measure-bounds{} --seed {} --out generator/tables/bounds.json",
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
    program::add_number(app, "--seed", options.seed, {}, "of all random rotations and signals")
        ->capture_default_str();
    app.add_option("--out", options.out, "the file to write")->check(program::not_empty())->required();
    return program::run(app, argc, argv, [&] { zonal::run(options); });
}
