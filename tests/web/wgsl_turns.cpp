//   zonal-wgsl-turns write TURNS.json | compare TURNED.f32
// Writes what run_wgsl.mjs turns by WGSL in a browser, and judges what came of it by the pointwise oracle:
// random and hard rotations and signals, tilts near the poles, within the bounds that banners publish. A
// mirror goes as -R to kernels that take none.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "support/accuracy.hpp"
#include "support/banner.hpp"

namespace {

using zonal::accuracy::Contestant;
using zonal::accuracy::Problem;

static_assert(std::endian::native == std::endian::little, "the file of values is little-endian");

constexpr int kOrders[] = {3, 4, 6};
constexpr unsigned kSeed = 20240611;

/// A kernel as it is called with a rotation R and a signal f.
struct Call {
    std::string text;
    std::string published;  ///< how banners call its bound
    int channels;
};

std::vector<Call> calls(int order) {
    const std::string prefix = fmt::format("zonal_order{}_", order);
    std::vector<Call> all;
    const auto add = [&](const std::string& kernel, const std::string& published,
                         const std::string& on_three) {
        all.push_back({prefix + kernel + "(R, f)", published, 1});
        all.push_back({prefix + kernel + "_rgb(R, f)", on_three, 3});
    };
    add("rotate", "rotate", order > 3 ? "rotate_channels" : "rotate");
    add("rotate_accurate", "rotate_accurate", "rotate_accurate");
    if (order == 4) add("rotate_polynomial", "rotate_polynomial", "rotate_polynomial");
    if (order < 6) add("rotate_zhf", "rotate_zhf", "rotate_zhf");  // browsers take seconds to compile it
    for (const int channels : {1, 3})
        all.push_back({fmt::format("{0}apply{1}({0}prepare(R), f)", prefix, channels == 3 ? "_rgb" : ""),
                       "apply", channels});
    return all;
}

std::vector<Problem> problems(int order) {
    std::vector<Problem> all = zonal::accuracy::problems<float>(order, 50, 3000, kSeed);
    std::mt19937_64 random(kSeed);
    const auto add = [&](const std::string& name, const zonal::cases::Matrix& rotation) {
        all.push_back({name, rotation, zonal::cases::random_signal(order, random)});
    };
    std::uniform_real_distribution<double> angle(-4, 4);
    for (int k = 0; k < 20; ++k) add("rotation about z", zonal::cases::about_axis({0, 0, 1}, angle(random)));
    for (const zonal::cases::Case& tilt : zonal::cases::tiny_tilts(random)) add(tilt.name, tilt.rotation);
    return all;
}

/// A contestant of a call's kernel that does `turn`.
Contestant<float> contestant(int order, const Call& call,
                             std::function<void(const float*, const float*, float*)> turn) {
    const zonal::banner::Bound bound = zonal::banner::bound(order, call.published);
    Contestant<float> kernel{call.text, std::move(turn), bound.excess};
    return bound.takes_mirrors ? kernel : zonal::accuracy::with_mirrors(order, kernel);
}

/// The matrices that a kernel is given.
std::vector<float> matrices(int order, const Call& call, const std::vector<Problem>& all) {
    std::vector<float> given;
    const auto noting = contestant(order, call, [&](const float* R, const float*, float* out) {
        given.insert(given.end(), R, R + 9);
        std::fill_n(out, order * order, 0.0f);
    });
    std::vector<float> out(order * order);
    for (const Problem& problem : all) {
        const std::vector<float> R(problem.rotation.begin(), problem.rotation.end());
        noting.rotate(R.data(), out.data(), out.data());
    }
    return given;
}

/// Floats as JSON: the shortest digits that give them back.
std::string json(const std::vector<float>& values) { return fmt::format("[{}]", fmt::join(values, ",")); }

/// [{order, count, signals, kernels: [{call, channels, rotations}]}]
void write_turns(const std::filesystem::path& path) {
    std::vector<std::string> turns;
    for (const int order : kOrders) {
        const std::vector<Problem> all = problems(order);
        std::vector<float> signals;
        for (const Problem& problem : all)
            signals.insert(signals.end(), problem.signal.begin(), problem.signal.end());
        std::vector<std::string> kernels;
        for (const Call& call : calls(order))
            kernels.push_back(fmt::format(R"({{"call":"{}","channels":{},"rotations":{}}})", call.text,
                                          call.channels, json(matrices(order, call, all))));
        turns.push_back(fmt::format(R"({{"order":{},"count":{},"signals":{},"kernels":[{}]}})", order,
                                    all.size(), json(signals), fmt::join(kernels, ",")));
    }
    std::ofstream file(path);
    if (!(file << fmt::format("[{}]\n", fmt::join(turns, ",\n"))))
        throw std::runtime_error(fmt::format("{}: cannot be written; choose another place", path.string()));
}

std::vector<float> read_values(const std::filesystem::path& path, std::size_t wanted) {
    std::vector<float> values(wanted);
    const auto size = static_cast<std::streamsize>(wanted * sizeof(float));
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(values.data()), size);
    if (file.gcount() != size || file.peek() != std::ifstream::traits_type::eof())
        throw std::runtime_error(
            fmt::format("{}: found another size, wanted {} bytes; run the page again", path.string(), size));
    return values;
}

void compare(const std::filesystem::path& path) {
    std::size_t wanted = 0;
    for (const int order : kOrders) wanted += problems(order).size() * calls(order).size() * order * order;
    const std::vector<float> values = read_values(path, wanted);
    const float* next = values.data();
    bool is_met = true;
    for (const int order : kOrders) {
        const std::vector<Problem> all = problems(order);
        std::vector<Contestant<float>> contestants;
        for (const Call& call : calls(order)) {
            contestants.push_back(
                contestant(order, call,
                           [at = next, size = order * order](const float*, const float*, float* out) mutable {
                               std::copy_n(at, size, out);
                               at += size;
                           }));
            next += all.size() * order * order;
        }
        const auto worst =
            zonal::accuracy::worst_errors<float>(zonal::oracle::Rotation(order), all, contestants);
        for (std::size_t k = 0; k < worst.size(); ++k) {
            const double bound = zonal::banner::bound(order, calls(order)[k].published).float_bound;
            const bool is_within = worst[k].error <= bound;
            fmt::print("  {:<60} {:.2g}, {:.2f} of its bound{}\n", contestants[k].name, worst[k].error,
                       worst[k].error / bound, is_within ? "" : "; worst: " + worst[k].name);
            is_met = is_met && is_within;
        }
    }
    std::fflush(stdout);  // before the error
    if (!is_met) throw std::runtime_error("WGSL in the browser exceeds the bounds that banners publish");
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    try {
        if (arguments.size() == 2 && arguments[0] == "write") {
            write_turns(arguments[1]);
        } else if (arguments.size() == 2 && arguments[0] == "compare") {
            compare(arguments[1]);
        } else {
            throw std::runtime_error(fmt::format("found '{}', wanted: write TURNS.json | compare TURNED.f32",
                                                 fmt::join(arguments, " ")));
        }
    } catch (const std::exception& problem) {
        fmt::print(stderr, "error: {}\n", problem.what());
        return 1;
    }
    return 0;
}
