// Speed of batches and single calls, beside memcpy of the same bytes and a measured peak of multiply-adds,
// with the largest error beside every time. Contestants of one workload and order form a group. Every round
// runs each contestant of a group once, in random order; a ratio is taken within its round, and the median of
// the rounds is reported: what the machine does to all of them at once cancels.

#include <benchmark/benchmark.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <nlohmann/json.hpp>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "batch/order_kernels.hpp"
#include "batch/targets.hpp"
#include "contestants.hpp"
#include "peak.hpp"
#include "program/numbers.hpp"
#include "program/program.hpp"
#include "support/accuracy.hpp"
#include "support/counting.hpp"
#include "support/hard_cases.hpp"
#include "zonal/batch.hpp"
#include "zonal/eigen.hpp"
#include "zonal/rotate.hpp"

namespace zonal::bench {
namespace {

constexpr int kErrorRotations = 300;
constexpr std::size_t kPeakRounds = 20000;

struct Options {
    std::vector<int> orders;
    std::vector<std::string> workloads{"single", "each", "quaternions", "all", "each-rgb", "all-rgb"};
    std::vector<std::string> places{"L2", "memory"};
    std::vector<std::string> types{"float", "double"};
    std::string target;
    int rounds = 9;
    double seconds = 0.004;
    std::size_t l2_kib = 512;
    std::size_t memory_mib = 512;
    std::size_t streamed_mib = batch::kStreamedBytes >> 20;
    std::string json;
    std::string command;  ///< as it was called, without folders of the program
};

/// One line of the report.
struct Result {
    std::string workload, place, contestant, type, target;
    int order = 0;
    double nanoseconds = 0;    ///< a vector, all its channels
    double to_memcpy = 0;      ///< of (bytes read + bytes written) / 2
    double to_zxzxz = 0;       ///< of single calls, else 0
    double to_zyz = 0;         ///< of single calls up to order 10, else 0
    double peak_fraction = 0;  ///< 0 where it has no meaning
    double error = 0;          ///< largest, relative to the norm of the vector
};

/// Something that is timed: `run` turns `vectors` vectors.
struct Contestant {
    std::string name;
    std::function<void()> run;
    double vectors = 1;
    double peak_instructions = 0;  ///< for one vector, over the lanes of a pack; 0: unknown
    double error = 0;
};

/// How vectors are turned: "single" calls, a rotation "each" (or as "quaternions") or one for "all", with a
/// number of interleaved channels ("all-16"), "planar" vectors, or "few" of them beside as many single calls.
struct Workload {
    std::string name;
    std::size_t channels = 1;
    std::size_t rotation_length = 9;  ///< values of a rotation; 0: all vectors share one
    bool is_planar = false;
    std::size_t few = 0;  ///< vectors, where they are few

    bool is_single() const { return name == "single"; }
};

Workload workload_of(const std::string& name) {
    const std::size_t dash = name.find('-');
    const std::string rotations = name.substr(0, dash);
    const std::string rest = dash == std::string::npos ? "" : name.substr(dash + 1);
    Workload workload{.name = name,
                      .rotation_length = rotations == "all"           ? 0U
                                         : rotations == "quaternions" ? 4U
                                                                      : 9U};
    const bool is_number = !rest.empty() && rest.find_first_not_of("0123456789") == std::string::npos;
    if (rest == "rgb")
        workload.channels = 3;
    else if (rest == "planar")
        workload.is_planar = true;
    else if (is_number && rotations == "few")
        workload.few = std::stoul(rest);
    else if (is_number)
        workload.channels = std::stoul(rest);
    const bool is_known = rotations == "single" || rotations == "each" || rotations == "quaternions" ||
                          rotations == "all" || workload.few > 0;
    if (!is_known || workload.channels == 0 ||
        (!rest.empty() && rest != "rgb" && rest != "planar" && !is_number))
        throw std::runtime_error(fmt::format(
            "--workloads: found {}, wanted single, each, quaternions or all, the last three also with -rgb, "
            "-planar or a number of channels (all-16); or few-3, three vectors beside as many single calls",
            name));
    return workload;
}

template <class T>
const char* type_name() {
    return std::is_same_v<T, float> ? "float" : "double";
}

double median(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + values.size() / 2);
    return values[values.size() / 2];
}

/// Rotations, vectors and room for results, one after the other in one piece of memory.
template <class T>
struct Data {
    std::span<T> rotations, in, out;
    std::size_t count;
};

template <class T>
Data<T> lay_out(std::vector<double>& memory, std::size_t bytes, int order, const Workload& workload) {
    const std::size_t length = workload.channels * order * order;
    // Whole packs; and half of all bytes are whole values, else the copy would make denormal numbers.
    const std::size_t fitting = bytes / sizeof(T) / (2 * length + workload.rotation_length);
    const std::size_t count = workload.few > 0 ? workload.few : fitting < 16 ? fitting : fitting / 16 * 16;
    const std::size_t shared = workload.rotation_length == 0 ? 9 : 0;
    memory.resize(std::max(memory.size(), bytes / sizeof(double) + 64));
    const std::span<T> values(reinterpret_cast<T*>(memory.data()),
                              memory.size() * sizeof(double) / sizeof(T));
    Data<T> data;
    data.count = count;
    data.rotations = values.first(count * workload.rotation_length + shared);
    data.in = values.subspan(data.rotations.size(), count * length);
    data.out = values.subspan(data.rotations.size() + data.in.size(), count * length);

    std::mt19937_64 random(1);
    std::normal_distribution<double> normal;
    std::vector<T> rotations;
    while (rotations.size() < 9 * 500 && rotations.size() < data.rotations.size()) {
        const Eigen::Quaterniond q =
            Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
        if (workload.rotation_length == 4) {
            for (const double value : q.coeffs()) rotations.push_back(static_cast<T>(value));
        } else {
            const RotationMatrix<T> matrix(q);
            rotations.insert(rotations.end(), matrix.data(), matrix.data() + 9);
        }
    }
    for (std::size_t i = 0; i < data.rotations.size(); ++i)
        data.rotations[i] = rotations[i % rotations.size()];
    std::vector<T> signal(4099);
    for (T& value : signal) value = static_cast<T>(normal(random));
    for (std::size_t i = 0; i < data.in.size(); ++i) data.in[i] = signal[i % signal.size()];
    return data;
}

template <class T>
void rotate_batch(int order, const Workload& workload, const Data<T>& data) {
    const std::span<const T> in(data.in), rotations(data.rotations);
    const auto rotate_in = [&](const auto& layout, const auto& from, const auto& to) {
        if (workload.rotation_length == 9)
            rotate_each(order, RotationMatrices<T>(rotations), layout, from, to);
        else if (workload.rotation_length == 4)
            rotate_each(order, RotationQuaternions<T>(rotations), layout, from, to);
        else
            rotate_all(order, *reinterpret_cast<const RotationMatrix<T>*>(rotations.data()), layout, from,
                       to);
    };
    if (workload.is_planar)
        rotate_in(PlanarLayout{.count = data.count}, Planes<const T>(in, data.count),
                  Planes<T>(data.out, data.count));
    else
        rotate_in(BatchLayout{.count = data.count, .channels = static_cast<int>(workload.channels)}, in,
                  data.out);
}

/// The same by single calls, of vectors with one channel and a rotation each.
template <class T>
void rotate_singly(int order, const Data<T>& data) {
    const std::size_t length = static_cast<std::size_t>(order) * order;
    for (std::size_t k = 0; k < data.count; ++k)
        rotate(order, RotationMatrix<T>::from_row_major(data.rotations.data() + 9 * k),
               std::span<const T>(data.in).subspan(k * length, length), data.out.subspan(k * length, length));
}

/// Largest error of rotate(R, f, out) over random rotations, against the pointwise oracle.
template <class T, class Rotate>
double largest_error(int order, const Rotate& rotate) {
    std::mt19937_64 random(3);
    std::vector<accuracy::Problem> problems;
    for (int k = 0; k < kErrorRotations; ++k) {
        const cases::Matrix rotation = cases::random_rotation(random);
        problems.push_back({"", rotation, cases::random_signal(order, random)});
    }
    const accuracy::Contestant<T> kernel{"", rotate};
    return accuracy::worst_errors<T>(oracle::Rotation(order), problems, {kernel}).front().error;
}

/// The same of one channel of a batch. A quaternion is judged with its own matrix, rounded to T.
template <class T>
double batch_error(int order, const Workload& workload) {
    return largest_error<T>(order, [&](const T* R, const T* f, T* out) {
        std::vector<T> in, turned(workload.channels * order * order);
        for (int i = 0; i < order * order; ++i) in.insert(in.end(), workload.channels, f[i]);
        Data<T> data{{}, in, turned, 1};
        std::vector<T> rotation(R, R + 9);
        if (workload.rotation_length == 4) {
            using RowMajor = Eigen::Matrix<T, 3, 3, Eigen::RowMajor>;
            const Eigen::Quaterniond q(Eigen::Map<const RowMajor>(R).template cast<double>());
            rotation.clear();
            for (const double value : q.normalized().coeffs()) rotation.push_back(static_cast<T>(value));
        }
        data.rotations = rotation;
        rotate_batch(order, workload, data);
        for (int i = 0; i < order * order; ++i) out[i] = turned[i * workload.channels];
    });
}

/// Instructions of the kernels for one vector with all its channels.
template <int N>
int instructions_of(const Workload& workload, bool is_fused, bool has_blocks) {
    using Kernels = PackKernels<N>;
    Counting R[9], f[N * N], scalars[Kernels::kScalars];
    const auto counted = [&](const auto& kernel) {
        Counting::tally = {};
        kernel();
        const Tally& t = Counting::tally;
        return t.mul + t.add + (is_fused ? 1 : 2) * t.fma + t.other;
    };
    const int once = counted([&] { AtOnce<N>::rotate(R, f); });
    const int prepare = counted([&] { Kernels::prepare(R, scalars); });
    const int apply = counted([&] { Kernels::apply(scalars, f); });
    if (workload.rotation_length > 0 && workload.channels == 1) return once;
    const bool is_dense = workload.rotation_length == 0 && workload.channels > 1 && workload.channels < 64;
    if (is_dense && has_blocks && turns_channels_densely(N))
        return (N * (4 * N * N - 1) / 3 - 1) * static_cast<int>(workload.channels) * (is_fused ? 1 : 2);
    return static_cast<int>(workload.channels) * apply + (workload.rotation_length > 0 ? prepare : 0);
}

int instructions_of(int order, const Workload& workload, bool is_fused, bool has_blocks) {
    switch (order) {
#define ZONAL_BENCH_CASE(N) \
    case N:                 \
        return instructions_of<N>(workload, is_fused, has_blocks);
        ZONAL_FOR_EACH_ORDER(ZONAL_BENCH_CASE)
#undef ZONAL_BENCH_CASE
    }
    return 0;
}

/// Keeps the time of one run of every benchmark.
class Collector : public benchmark::BenchmarkReporter {
  public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs)
            if (run.run_type == Run::RT_Iteration)
                seconds[run.run_name.function_name] =
                    run.real_accumulated_time / static_cast<double>(run.iterations);
    }
    std::map<std::string, double> seconds;  ///< of one iteration
};

/// Every round of a group; seconds of one iteration by contestant and round.
std::map<std::string, std::vector<double>> race(const std::vector<Contestant>& contestants,
                                                const Options& options, bool is_long) {
    benchmark::ClearRegisteredBenchmarks();
    for (const Contestant& contestant : contestants) {
        auto* entry =
            benchmark::RegisterBenchmark(contestant.name.c_str(), [&contestant](benchmark::State& state) {
                for (auto iteration : state) {
                    contestant.run();
                    benchmark::ClobberMemory();
                }
            })->UseRealTime();
        if (is_long)
            entry->Iterations(1);
        else
            entry->MinTime(options.seconds);
    }
    std::map<std::string, std::vector<double>> times;
    for (int round = 0; round <= options.rounds; ++round) {
        Collector collector;
        benchmark::RunSpecifiedBenchmarks(&collector);
        if (round == 0) continue;  // warms up
        for (const auto& [name, seconds] : collector.seconds)
            times[name.substr(0, name.find('/'))].push_back(seconds);
    }
    return times;
}

template <class T>
std::vector<Contestant> contestants_of(int order, const Workload& workload, const Data<T>& data,
                                       bool is_long) {
    std::vector<Contestant> contestants;
    const Peak peak = peak_of<T>(batch::chosen_target());
    const double vectors = static_cast<double>(data.count);
    const auto add = [&](const SingleCall<T>& call) {
        const Arrays<T> arrays{data.rotations.data(), data.in.data(), data.out.data(), data.count};
        contestants.push_back(
            {call.name, [=] { call.run(arrays); }, vectors, 0, largest_error<T>(order, call.rotate)});
    };
    if (workload.is_single()) {
        for (const SingleCall<T>& call : single_calls<T>(order)) add(call);
    } else {
        contestants.push_back({"zonal", [=] { rotate_batch(order, workload, data); }, vectors,
                               static_cast<double>(instructions_of(order, workload, peak.is_fused,
                                                                   sizeof(T) == 4 && peak.lanes >= 4)) /
                                   static_cast<double>(peak.lanes),
                               batch_error<T>(order, workload)});
        if (workload.name == "all") add(dense_product<T>(order));
        if (workload.few > 0)
            contestants.push_back({"single calls", [=] { rotate_singly(order, data); }, vectors});
    }
    // The copy goes from the first half of all bytes to the second.
    const std::size_t length = workload.channels * order * order;
    const std::size_t bytes = data.count * (2 * length + workload.rotation_length) * sizeof(T) / 2;
    char* begin = reinterpret_cast<char*>(data.rotations.data());
    contestants.push_back({"memcpy", [=] { std::memcpy(begin + bytes, begin, bytes); }, vectors});
    if (!is_long || !workload.is_single())
        contestants.push_back({"peak", [peak] { benchmark::DoNotOptimize(peak.run(kPeakRounds)); },
                               static_cast<double>(kPeakRounds * kPeakChains)});
    return contestants;
}

template <class T>
void measure(int order, const Workload& workload, const std::string& place, const Options& options,
             std::vector<double>& memory, std::vector<Result>& results) {
    const bool is_long = place == "memory";
    const std::size_t bytes = is_long ? options.memory_mib << 20 : options.l2_kib << 10;
    const Data<T> data = lay_out<T>(memory, bytes, order, workload);
    const std::vector<Contestant> contestants = contestants_of<T>(order, workload, data, is_long);
    // memcpy overwrites what the others read with other vectors, which are as good.
    const auto times = race(contestants, options, is_long);
    for (const Contestant& contestant : contestants) {
        if (contestant.name == "memcpy" || contestant.name == "peak") continue;
        const std::vector<double>& seconds = times.at(contestant.name);
        std::vector<double> nanoseconds, to_memcpy, to_zxzxz, to_zyz, fraction;
        for (std::size_t round = 0; round < seconds.size(); ++round) {
            nanoseconds.push_back(1e9 * seconds[round] / contestant.vectors);
            to_memcpy.push_back(seconds[round] / times.at("memcpy")[round]);
            if (workload.is_single()) to_zxzxz.push_back(seconds[round] / times.at(kZxzxz)[round]);
            if (times.contains(kZyz)) to_zyz.push_back(seconds[round] / times.at(kZyz)[round]);
            if (contestant.peak_instructions > 0)
                fraction.push_back(contestant.peak_instructions * times.at("peak")[round] /
                                   static_cast<double>(kPeakRounds * kPeakChains) /
                                   (seconds[round] / contestant.vectors));
        }
        results.push_back({.workload = workload.name,
                           .place = place,
                           .contestant = contestant.name,
                           .type = type_name<T>(),
                           .target = workload.is_single() ? "scalar" : std::string(batch::chosen_target()),
                           .order = order,
                           .nanoseconds = median(nanoseconds),
                           .to_memcpy = median(to_memcpy),
                           .to_zxzxz = to_zxzxz.empty() ? 0 : median(to_zxzxz),
                           .to_zyz = to_zyz.empty() ? 0 : median(to_zyz),
                           .peak_fraction = fraction.empty() ? 0 : median(fraction),
                           .error = contestant.error});
        const Result& r = results.back();
        const auto ratio = [](double value) { return value > 0 ? fmt::format("{:.3f}", value) : ""; };
        fmt::print("| {} | {} | {} | {} | {} | {} | {:.2f} | {:.2f} | {} | {} | {} | {:.1e} |\n", r.workload,
                   r.place, r.order, r.contestant, r.type, r.target, r.nanoseconds, r.to_memcpy,
                   ratio(r.to_zxzxz), ratio(r.to_zyz),
                   r.peak_fraction > 0 ? fmt::format("{:.0f} %", 100 * r.peak_fraction) : "", r.error);
        std::fflush(stdout);
    }
}

/// The processor as Linux names it, with family and model: names of virtual machines tell little.
std::string processor() {
    std::map<std::string, std::string> facts;
    std::ifstream stream("/proc/cpuinfo");
    for (std::string line; std::getline(stream, line) && !line.empty();) {
        const std::size_t colon = line.find(':');
        if (colon + 2 < line.size()) facts[line.substr(0, line.find('\t'))] = line.substr(colon + 2);
    }
    if (!facts.contains("model name")) return "unknown";
    return fmt::format("{}, family {}, model {}", facts["model name"], facts["cpu family"], facts["model"]);
}

void write_json(const std::string& path, const std::vector<Result>& results, const Options& options) {
    nlohmann::json json;
    json["machine"] = processor();
    json["compiler"] = ZONAL_BENCH_COMPILER;
    json["flags"] = ZONAL_BENCH_FLAGS;
    json["date"] = fmt::format("{:%Y-%m-%d}", fmt::gmtime(std::time(nullptr)));
    json["command"] = options.command;
    json["rounds"] = options.rounds;
    json["l2_kib"] = options.l2_kib;
    json["memory_mib"] = options.memory_mib;
    json["error_rotations"] = kErrorRotations;
    for (const Result& r : results) {
        nlohmann::json line{{"workload", r.workload},     {"place", r.place},         {"order", r.order},
                            {"contestant", r.contestant}, {"type", r.type},           {"target", r.target},
                            {"ns", r.nanoseconds},        {"to_memcpy", r.to_memcpy}, {"error", r.error}};
        if (r.to_zxzxz > 0) line["to_zxzxz"] = r.to_zxzxz;
        if (r.to_zyz > 0) line["to_zyz"] = r.to_zyz;
        if (r.peak_fraction > 0) line["peak_fraction"] = r.peak_fraction;
        json["results"].push_back(std::move(line));
    }
    std::ofstream stream(path);
    stream << json.dump(1) << '\n';
    if (!stream) throw std::runtime_error(path + ": cannot be written");
}

void run(const Options& options) {
    if (!batch::choose_target(options.target))
        throw std::runtime_error(fmt::format("--target: found {}, wanted one of: {}", options.target,
                                             fmt::join(batch::runnable_targets(), ", ")));
    batch::set_streamed_bytes(options.streamed_mib << 20);
    fmt::print(
        "Time of one vector (all channels) on one core; ratio to memcpy of (bytes read + written) / 2, "
        "rotations\n"
        "included; of single calls, ratios to the z-x-z-x-z product with angles (sine and cosine included) "
        "and to\nz-y-z without angles; share of the measured peak of multiply-adds on the same packs that "
        "the kernel's own\n"
        "instructions make; largest error over {} random rotations. Medians of {} interleaved rounds.\n"
        "L2: {} KiB in all; memory: {} MiB.\n\n"
        "| workload | from | N | contestant | type | packs | ns | / memcpy | / zxzxz | / z-y-z | of peak | "
        "error |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|\n",
        kErrorRotations, options.rounds, options.l2_kib, options.memory_mib);
    std::vector<double> memory;
    std::vector<Result> results;
    const auto wanted = [](const std::vector<std::string>& list, const std::string& name) {
        return std::ranges::find(list, name) != list.end();
    };
    for (const std::string& name : options.workloads) {
        const Workload workload = workload_of(name);
        for (const std::string& place : options.places) {
            if (workload.few > 0 && place == "memory") continue;
            for (const int order : compiled_orders()) {
                if (std::ranges::find(options.orders, order) == options.orders.end()) continue;
                if (wanted(options.types, "float"))
                    measure<float>(order, workload, place, options, memory, results);
                if (wanted(options.types, "double"))
                    measure<double>(order, workload, place, options, memory, results);
            }
        }
    }
    if (!options.json.empty()) write_json(options.json, results, options);
}

}  // namespace
}  // namespace zonal::bench

int main(int argc, char** argv) {
    CLI::App app{"Times batches and single calls of every compiled order, with the error beside every time."};
    zonal::bench::Options options;
    options.orders.assign(zonal::compiled_orders().begin(), zonal::compiled_orders().end());
    using zonal::program::add_number;
    const auto blocks = zonal::program::from_to<std::size_t>(1, std::size_t{1} << 30U);
    zonal::program::add_numbers(app, "--orders", options.orders, zonal::program::at_least(1),
                                "orders to time")
        ->delimiter(',');
    app.add_option(
           "--workloads", options.workloads,
           "single, each, quaternions, all; the last three with -rgb, -planar or channels: all-16; few-3")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--places", options.places, "L2, memory")->delimiter(',')->capture_default_str();
    app.add_option("--types", options.types, "float, double")->delimiter(',')->capture_default_str();
    app.add_option("--target", options.target, "instruction set of the packs, default the best");
    add_number(app, "--rounds", options.rounds, zonal::program::at_least(1), "of every workload")
        ->capture_default_str();
    add_number(app, "--seconds", options.seconds, zonal::program::above(0, 1e6),
               "shortest time of a run in cache")
        ->capture_default_str();
    add_number(app, "--l2-kib", options.l2_kib, blocks, "bytes of a workload in cache")
        ->capture_default_str();
    add_number(app, "--memory-mib", options.memory_mib, blocks,
               "bytes of a workload in memory: several times the last cache")
        ->capture_default_str();
    add_number(app, "--streamed-mib", options.streamed_mib, blocks,
               "batches larger than this are written past the caches")
        ->capture_default_str();
    app.add_option("--json", options.json, "also write the results to this file");
    options.command = std::filesystem::path(argv[0]).filename().string();
    for (int k = 1; k < argc; ++k) options.command += std::string(" ") + argv[k];
    return zonal::program::run(app, argc, argv, [&] {
        // Every call of the library runs the group registered at that time, in random order.
        std::vector<std::string> arguments{"zonal-bench", "--benchmark_enable_random_interleaving=true"};
        std::vector<char*> pointers;
        for (std::string& argument : arguments) pointers.push_back(argument.data());
        int count = static_cast<int>(pointers.size());
        benchmark::Initialize(&count, pointers.data());
        zonal::bench::run(options);
    });
}
