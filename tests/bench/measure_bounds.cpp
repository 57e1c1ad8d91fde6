// Measures the error bounds that banners publish, and writes them to generator/tables/bounds.json.
//
// Method: for every rotation (random ones and the hard cases) the kernel turns each unit vector; the
// differences from the oracle are the columns of an error matrix, and its leading right singular vector is a
// signal that the kernel turns as badly as any. The published bound is the largest error met with such
// signals times a margin.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Dense>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <regex>
#include <sstream>

#include "support/accuracy.hpp"
#include "support/kernels.hpp"

namespace zonal {
namespace {

/// Over the largest error met: rotations and roundings that were not tried.
constexpr double kMargin = 1.5;

struct Options {
    int rotations = 3000;
    std::uint64_t seed = 1;
    std::string out;
};

/// The signal that this rotation turns worst, to first order.
template <class T, class Rotate>
std::vector<double> worst_signal(int order, const oracle::Rotation& exact, const cases::Matrix& rotation,
                                 Rotate rotate) {
    const int count = order * order;
    T r[9];
    std::copy(rotation.begin(), rotation.end(), r);
    oracle::Matrix3 given;
    std::copy(r, r + 9, given.begin());
    Eigen::MatrixXd errors(count, count);
    for (int i = 0; i < count; ++i) {
        std::vector<T> f(count, 0), out(count);
        f[i] = 1;
        rotate(r, f.data(), out.data());
        const std::vector<oracle::Real> expected = exact(given, {f.begin(), f.end()});
        for (int k = 0; k < count; ++k) errors(k, i) = static_cast<double>(out[k] - expected[k]);
    }
    const Eigen::BDCSVD<Eigen::MatrixXd> svd(errors, Eigen::ComputeThinV);
    const Eigen::VectorXd direction = svd.matrixV().col(0);
    return {direction.begin(), direction.end()};
}

template <class T, class Rotate>
double measured_bound(int order, const Options& options, Rotate rotate) {
    std::mt19937_64 random(options.seed);
    const oracle::Rotation exact(order);
    double worst = accuracy::worst_error<T>(order, options.rotations, options.seed, rotate).beyond_excused;
    std::vector<cases::Case> rotations = cases::hard_rotations<T>(random);
    for (int k = 0; k < options.rotations; ++k) rotations.push_back({"", cases::random_rotation(random)});
    for (const cases::Case& c : rotations) {
        const std::vector<double> signal = worst_signal<T>(order, exact, c.rotation, rotate);
        worst =
            std::max(worst, accuracy::measure<T>(order, exact, c.rotation, signal, rotate).beyond_excused());
    }
    return kMargin * worst;
}

/// Two digits, rounded up.
std::string rounded_up(double bound) {
    const double unit = std::pow(10.0, std::floor(std::log10(bound)) - 1);
    return fmt::format("{:.1e}", std::ceil(bound / unit) * unit);
}

/// The table that a generated header was made from, as its banner names it.
std::string table_hash(int order) {
    const std::string path = fmt::format("{}/zonal/order{:02}.hpp", ZONAL_GENERATED_DIR, order);
    std::ifstream stream(path);
    std::stringstream text;
    text << stream.rdbuf();
    const std::string content = text.str();
    std::smatch match;
    if (!std::regex_search(content, match, std::regex("sha256:([0-9a-f]{16})")))
        throw std::runtime_error(path + ": the banner names no table; write it again with zonal-gen emit");
    return match[1];
}

template <int N>
void append_order(const Options& options, nlohmann::ordered_json& bounds) {
    const auto rotate = [](const auto* R, const auto* f, auto* out) { Order<N>::rotate_zhf(R, f, out); };
    bounds.push_back({{"kernel", "rotate_zhf"},
                      {"order", N},
                      {"table", table_hash(N)},
                      {"float", rounded_up(measured_bound<float>(N, options, rotate))},
                      {"double", rounded_up(measured_bound<double>(N, options, rotate))}});
    fmt::print("{}\n", bounds.back().dump());
    std::fflush(stdout);
}

void run(const Options& options) {
    nlohmann::ordered_json bounds = nlohmann::ordered_json::array();
#define ZONAL_APPEND_ORDER(N) append_order<N>(options, bounds);
    ZONAL_FOR_EACH_ORDER(ZONAL_APPEND_ORDER)
#undef ZONAL_APPEND_ORDER
    const std::string command =
        fmt::format("zonal-measure-bounds --rotations {} --seed {} --out generator/tables/bounds.json",
                    options.rotations, options.seed);
    const std::string temporary = options.out + ".tmp";
    std::ofstream stream(temporary);
    stream << nlohmann::ordered_json{{"command", command}, {"margin", kMargin}, {"bounds", bounds}}.dump(2)
           << "\n";
    stream.close();
    if (!stream)
        throw std::runtime_error(temporary + ": cannot be written; choose another folder with --out");
    std::filesystem::rename(temporary, options.out);
}

}  // namespace
}  // namespace zonal

int main(int argc, char** argv) {
    CLI::App app{"Measures the error bounds that generated banners publish."};
    zonal::Options options;
    app.add_option("--rotations", options.rotations, "random rotations for each kernel and type")
        ->capture_default_str();
    app.add_option("--seed", options.seed)->capture_default_str();
    app.add_option("--out", options.out, "the file to write")->required();
    CLI11_PARSE(app, argc, argv);
    try {
        zonal::run(options);
    } catch (const std::exception& error) {
        fmt::print(stderr, "error: {}\n", error.what());
        return 1;
    }
    return 0;
}
