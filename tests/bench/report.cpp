// Error beside time for every kernel of the orders that are compiled in, with the counts that `zonal-gen
// stats` gives where it is told to: what the main job prints and README.md beside this shows.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <cstring>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "program/numbers.hpp"
#include "program/program.hpp"
#include "support/accuracy.hpp"
#include "support/kernels.hpp"

namespace zonal {
namespace {

constexpr int kVectors =
    256;  // in cache: at N = 6 and double, 256 vectors, results and rotations take 166 KiB
constexpr int kRotations = 10000;
constexpr const char* kBaseline = "memcpy";

const std::vector<std::string> kKernels{"rotate", "rotate_accurate"};
const std::vector<std::string> kTensorKernels{"rotate_tensor"};
const std::vector<std::string> kLobeKernels{"rotate_zhf", "factorize", "expand", "resample", "lobes"};

/// The vectors one benchmark works on: a rotation of its own for each, plain arrays.
template <int N, class T>
struct Workload {
    std::vector<T> rotations, in, out, directions;

    Workload() : in(kVectors * N * N), out(in.size()), directions(kVectors * 3 * (2 * N - 1)) {
        std::mt19937_64 random(1);
        for (int k = 0; k < kVectors; ++k)
            for (const double entry : cases::random_rotation(random))
                rotations.push_back(static_cast<T>(entry));
        std::normal_distribution<double> normal;
        for (T& value : in) value = static_cast<T>(normal(random));
    }
};

template <class T>
const char* type_name() {
    return std::is_same_v<T, float> ? "float" : "double";
}

std::string benchmark_name(int order, const std::string& kernel, const char* type) {
    return fmt::format("{}/{}/{}", order, kernel, type);
}

/// Registers `run(rotation, in, out, directions)` over the whole workload.
template <int N, class T, class Run>
void register_benchmark(const std::string& kernel, Run run) {
    benchmark::RegisterBenchmark(
        benchmark_name(N, kernel, type_name<T>()).c_str(), [run](benchmark::State& state) {
            Workload<N, T> work;
            for (auto iteration : state) {
                for (int k = 0; k < kVectors; ++k)
                    run(work.rotations.data() + 9 * k, work.in.data() + N * N * k,
                        work.out.data() + N * N * k, work.directions.data() + 3 * (2 * N - 1) * k);
                benchmark::ClobberMemory();
            }
        });
}

template <int N, class T>
void register_benchmarks() {
    const auto add = [](const char* kernel, auto run) { register_benchmark<N, T>(kernel, run); };
    add("rotate", [](const T* R, const T* in, T* out, T*) { Order<N>::rotate(R, in, out); });
    add("rotate_accurate",
        [](const T* R, const T* in, T* out, T*) { Order<N>::rotate_accurate(R, in, out); });
    add(kBaseline, [](const T*, const T* in, T* out, T*) { std::memcpy(out, in, N * N * sizeof(T)); });
}

template <int N, class T>
void register_tensor_benchmarks() {
    register_benchmark<N, T>("rotate_tensor",
                             [](const T* R, const T* in, T* out, T*) { TensorOrder<N>::rotate(R, in, out); });
}

template <int N, class T>
void register_lobe_benchmarks() {
    using Kernels = LobeOrder<N>;
    const auto add = [](const char* kernel, auto run) { register_benchmark<N, T>(kernel, run); };
    add("rotate_zhf", [](const T* R, const T* in, T* out, T*) { Kernels::rotate_zhf(R, in, out); });
    add("factorize", [](const T*, const T* in, T* out, T*) { Kernels::factorize(in, out); });
    add("expand", [](const T*, const T* in, T* out, T*) { Kernels::expand(in, out); });
    add("resample", [](const T*, const T* in, T* out, T*) { Kernels::resample(in, out); });
    add("lobes", [](const T* R, const T*, T*, T* directions) { Kernels::lobes(R, directions); });
}

using Errors = std::map<std::string, double>;

/// Largest errors of kernels that turn a signal, rotations that are meant not to be orthonormal left out.
template <class T>
void note_worst(Errors& errors, int order, const std::vector<accuracy::Contestant<T>>& kernels) {
    const int random_count = order <= 6 ? kRotations : kRotations / 10, thinning = order <= 6 ? 1 : 10;
    const auto worst = accuracy::worst_errors<T>(
        oracle::Rotation(order), accuracy::problems<T>(order, random_count, thinning, 1), kernels);
    for (std::size_t k = 0; k < kernels.size(); ++k) errors[kernels[k].name] = worst[k].error_of_rotations;
}

template <int N, class T>
Errors measure_errors() {
    const accuracy::Contestant<T> rotate{"rotate",
                                         [](const T* R, const T* f, T* out) { Order<N>::rotate(R, f, out); }};
    const accuracy::Contestant<T> accurate{
        "rotate_accurate", [](const T* R, const T* f, T* out) { Order<N>::rotate_accurate(R, f, out); }};
    Errors errors;
    note_worst<T>(errors, N,
                  {Order<N>::kTakesMirrors ? rotate : accuracy::with_mirrors(N, rotate), accurate});
    return errors;
}

template <int N, class T>
Errors measure_tensor_errors() {
    Errors errors;
    note_worst<T>(
        errors, N,
        {{"rotate_tensor", [](const T* R, const T* f, T* out) { TensorOrder<N>::rotate(R, f, out); }}});
    return errors;
}

/// Largest error of each kernel against the oracle, relative to the input's norm.
template <int N, class T>
Errors measure_lobe_errors() {
    using oracle::Real;
    using Kernels = LobeOrder<N>;
    Errors worst;
    const auto note = [&](const std::string& kernel, double error) {
        worst[kernel] = std::max(worst[kernel], error);
    };
    note_worst<T>(worst, N,
                  {{"rotate_zhf", [](const T* R, const T* f, T* out) { Kernels::rotate_zhf(R, f, out); }}});

    constexpr int kLobes = 2 * N - 1;
    const double identity[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    double still[3 * kLobes];
    Kernels::lobes(identity, still);
    std::vector<std::vector<Real>> basis_at_lobe;
    for (int d = 0; d < kLobes; ++d)
        basis_at_lobe.push_back(oracle::basis(N, {still[3 * d], still[3 * d + 1], still[3 * d + 2]}));
    const auto relative = [](const std::vector<Real>& a, const T* b, const T* input) {
        Real difference = 0, norm = 0;
        for (int i = 0; i < N * N; ++i) {
            difference += (a[i] - b[i]) * (a[i] - b[i]);
            norm += static_cast<Real>(input[i]) * input[i];
        }
        return static_cast<double>(std::sqrt(difference / norm));
    };
    // sum over bands and lobes of z_ld y_l(ω_d), or its transpose
    const auto expand_exactly = [&](const T* z) {
        std::vector<Real> f(N * N, 0);
        for (int l = 0; l < N; ++l)
            for (int d = 0; d < 2 * l + 1; ++d)
                for (int i = l * l; i < (l + 1) * (l + 1); ++i) f[i] += basis_at_lobe[d][i] * z[l * l + d];
        return f;
    };
    std::mt19937_64 random(2);
    for (int k = 0; k < kRotations; ++k) {
        const std::vector<double> signal = cases::random_signal(N, random);
        const std::vector<T> f(signal.begin(), signal.end());
        T out[N * N], samples[N * N], directions[3 * kLobes], r[9];
        Kernels::factorize(f.data(), out);
        const std::vector<Real> back = expand_exactly(out);
        note("factorize", relative(back, f.data(), f.data()));
        Kernels::expand(f.data(), out);
        note("expand", relative(expand_exactly(f.data()), out, f.data()));
        for (int l = 0; l < N; ++l) {
            for (int d = 0; d < 2 * l + 1; ++d) {
                Real sample = 0;
                for (int i = l * l; i < (l + 1) * (l + 1); ++i) sample += basis_at_lobe[d][i] * f[i];
                samples[l * l + d] = static_cast<T>(sample);
            }
        }
        Kernels::resample(samples, out);
        note("resample", relative({f.begin(), f.end()}, out, f.data()));
        const cases::Matrix rotation = cases::random_rotation(random);
        std::copy(rotation.begin(), rotation.end(), r);
        Kernels::lobes(r, directions);
        for (int d = 0; d < kLobes; ++d) {
            Real difference = 0;
            for (int i = 0; i < 3; ++i) {
                Real exact = 0;
                for (int j = 0; j < 3; ++j) exact += static_cast<Real>(r[3 * i + j]) * still[3 * d + j];
                difference += (exact - directions[3 * d + i]) * (exact - directions[3 * d + i]);
            }
            note("lobes", static_cast<double>(std::sqrt(difference)));
        }
    }
    return worst;
}

/// Keeps every median instead of printing it.
class Collector : public benchmark::BenchmarkReporter {
  public:
    bool ReportContext(const Context&) override { return true; }
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs)
            if (run.run_type == Run::RT_Aggregate && run.aggregate_name == "median")
                nanoseconds_[run.run_name.function_name] = run.GetAdjustedRealTime() / kVectors;
    }
    double nanoseconds(const std::string& name) const { return nanoseconds_.at(name); }

  private:
    std::map<std::string, double> nanoseconds_;
};

void print_stats(const std::string& path) {
    std::ifstream stream(path);
    if (!stream)
        throw std::runtime_error(path + ": cannot be read; write it with: zonal-gen stats --order N --json");
    const auto stats = nlohmann::json::parse(stream);
    fmt::print("\nOrder {} (degree {})\n\n", stats["order"].get<int>(), stats["order"].get<int>() - 1);
    if (stats.contains("bands")) {
        fmt::print("| band | entries | zeros | multiplications | cond |\n|---|---|---|---|---|\n");
        for (const auto& band : stats["bands"])
            fmt::print("| {} | {} | {} | {} | {:.3g} |\n", band["band"].get<int>(),
                       band["entries"].get<int>(), band["zeros"].get<int>(),
                       band["multiplications"].get<int>(), band["cond"].get<double>());
    }
    fmt::print("\n| kernel | mul | add | fma | other |\n|---|---|---|---|---|\n");
    for (const auto& [name, kernel] : stats["kernels"].items())
        fmt::print("| {} | {} | {} | {} | {} |\n", name, kernel["mul"].get<int>(), kernel["add"].get<int>(),
                   kernel["fma"].get<int>(), kernel["other"].get<int>());
}

void print_rows(int order, const Collector& times, const std::vector<std::string>& kernels,
                const Errors& single, const Errors& twice) {
    const auto ns = [&](const std::string& kernel, const char* type) {
        return times.nanoseconds(benchmark_name(order, kernel, type));
    };
    for (const std::string& kernel : kernels)
        fmt::print("| {} | {} | {:.1e} | {:.1f} | {:.1e} | {:.1f} |\n", order, kernel, single.at(kernel),
                   ns(kernel, "float"), twice.at(kernel), ns(kernel, "double"));
}

void run(const std::string& stats, double seconds) {
    if (!stats.empty()) print_stats(stats);
#define ZONAL_REGISTER(N)            \
    register_benchmarks<N, float>(); \
    register_benchmarks<N, double>();
    ZONAL_FOR_EACH_ORDER(ZONAL_REGISTER)
#undef ZONAL_REGISTER
#define ZONAL_REGISTER(N)                   \
    register_tensor_benchmarks<N, float>(); \
    register_tensor_benchmarks<N, double>();
    ZONAL_FOR_EACH_TENSOR_ORDER(ZONAL_REGISTER)
#undef ZONAL_REGISTER
#define ZONAL_REGISTER(N)                 \
    register_lobe_benchmarks<N, float>(); \
    register_lobe_benchmarks<N, double>();
    ZONAL_FOR_EACH_ZHF_ORDER(ZONAL_REGISTER)
#undef ZONAL_REGISTER
    // Interleaved, so that a machine whose speed drifts does not favour one kernel.
    std::vector<std::string> arguments{"zonal-report", "--benchmark_enable_random_interleaving=true",
                                       "--benchmark_repetitions=9",
                                       fmt::format("--benchmark_min_time={}", seconds)};
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    int argc = static_cast<int>(argv.size());
    benchmark::Initialize(&argc, argv.data());
    Collector times;
    benchmark::RunSpecifiedBenchmarks(&times);

#if defined(__FMA__)
    const char* fused = "with fused multiply-add";
#else
    const char* fused = "without fused multiply-add";
#endif
    fmt::print(
        "\nLargest error over {} random rotations (a tenth above order 6) and the hard ones, relative to the "
        "input.\n"
        "Time of one call, one core, {}: {} vectors in cache, each with a rotation of its own; median of 9\n"
        "interleaved runs; memcpy copies the vector.\n\n",
        kRotations, fused, kVectors);
    fmt::print(
        "| N | kernel | error, float | ns, float | error, double | ns, double "
        "|\n|---|---|---|---|---|---|\n");
#define ZONAL_PRINT(N)                                                                       \
    print_rows(N, times, kKernels, measure_errors<N, float>(), measure_errors<N, double>()); \
    print_rows(N, times, {kBaseline}, {{kBaseline, 0}}, {{kBaseline, 0}});
    ZONAL_FOR_EACH_ORDER(ZONAL_PRINT)
#undef ZONAL_PRINT
#define ZONAL_PRINT(N)                                                      \
    print_rows(N, times, kTensorKernels, measure_tensor_errors<N, float>(), \
               measure_tensor_errors<N, double>());
    ZONAL_FOR_EACH_TENSOR_ORDER(ZONAL_PRINT)
#undef ZONAL_PRINT
#define ZONAL_PRINT(N) \
    print_rows(N, times, kLobeKernels, measure_lobe_errors<N, float>(), measure_lobe_errors<N, double>());
    ZONAL_FOR_EACH_ZHF_ORDER(ZONAL_PRINT)
#undef ZONAL_PRINT
}

}  // namespace
}  // namespace zonal

int main(int argc, char** argv) {
    CLI::App app{"Prints error beside time for every kernel of the orders that are compiled in."};
    std::string stats;
    double seconds = 0.01;
    app.add_option("--stats", stats, "what `zonal-gen stats --json` printed, to show counts as well");
    zonal::program::add_number(app, "--seconds", seconds, zonal::program::above(0, 1e6),
                               "shortest time of one run")
        ->capture_default_str();
    return zonal::program::run(app, argc, argv, [&] { zonal::run(stats, seconds); });
}
