//   zonal-language-turns LANGUAGE write TURNS.json | LANGUAGE compare TURNED.bin
// Writes what run_wgsl.mjs turns by WGSL in a browser and run_js.mjs by JavaScript, and judges what came of
// it by the pointwise oracle: random and hard rotations and signals, tilts near the poles, within the bounds
// that banners publish. WGSL computes in single precision, JavaScript in double. A mirror goes as -R to
// kernels that take none.

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
#include <type_traits>
#include <utility>
#include <vector>

#include "support/accuracy.hpp"
#include "support/banner.hpp"

namespace {

using zonal::accuracy::Contestant;
using zonal::accuracy::Problem;

static_assert(std::endian::native == std::endian::little, "the file of values is little-endian");

constexpr unsigned kSeed = 20240611;

/// A kernel as it is called with a rotation R and a signal f.
struct Call {
    std::string text;
    std::vector<std::string> files;  ///< that it needs
    std::string published;           ///< how banners call its bound
    int channels;
};

struct Wgsl {
    using Number = float;
    static constexpr const char* kName = "WGSL in the browser";
    static constexpr int kOrders[] = {3, 4, 6};

    static std::vector<Call> calls(int order) {
        const std::string prefix = fmt::format("zonal_order{}_", order);
        std::vector<Call> all;
        const auto add = [&](const std::string& kernel, const std::string& on_three) {
            const std::string on_one = kernel == "rotate" ? "rotate_fewest" : kernel;  // what shaders choose
            all.push_back({prefix + kernel + "(R, f)", {kernel}, on_one, 1});
            all.push_back({prefix + kernel + "_rgb(R, f)", {kernel}, on_three, 3});
        };
        add("rotate", order > 3 ? "rotate_channels" : "rotate");
        add("rotate_accurate", "rotate_accurate");
        if (order == 4) add("rotate_tensor", "rotate_tensor");
        if (order < 6) add("rotate_zhf", "rotate_zhf");  // browsers take seconds to compile it
        for (const int channels : {1, 3})
            all.push_back({fmt::format("{0}apply{1}({0}prepare(R), f)", prefix, channels == 3 ? "_rgb" : ""),
                           {"prepare", "apply"},
                           "apply",
                           channels});
        return all;
    }
};

struct JavaScript {
    using Number = double;
    static constexpr const char* kName = "JavaScript";
    static constexpr int kOrders[] = {2, 3, 4, 5, 6, 7, 8, 9, 10};

    static std::vector<Call> calls(int order) {
        return {{"rotate", {"rotate"}, "rotate", 1},
                {"rotate_rgb", {"rotate"}, order > 3 ? "rotate_channels" : "rotate", 3},
                {"rotate_accurate", {"rotate_accurate"}, "rotate_accurate", 1},
                {"rotate_accurate_rgb", {"rotate_accurate"}, "rotate_accurate", 3}};
    }
};

template <class T>
std::vector<Problem> problems(int order) {
    std::vector<Problem> all = zonal::accuracy::problems<T>(order, 50, 3000, kSeed);
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
template <class T>
Contestant<T> contestant(int order, const Call& call, std::function<void(const T*, const T*, T*)> turn) {
    const zonal::banner::Bound bound = zonal::banner::bound(order, call.published);
    Contestant<T> kernel{call.text, std::move(turn), bound.excess};
    return bound.takes_mirrors ? kernel : zonal::accuracy::with_mirrors(order, kernel);
}

/// The matrices that a kernel is given.
template <class T>
std::vector<T> matrices(int order, const Call& call, const std::vector<Problem>& all) {
    std::vector<T> given;
    const auto noting = contestant<T>(order, call, [&](const T* R, const T*, T* out) {
        given.insert(given.end(), R, R + 9);
        std::fill_n(out, order * order, T(0));
    });
    std::vector<T> out(order * order);
    for (const Problem& problem : all) {
        const std::vector<T> R(problem.rotation.begin(), problem.rotation.end());
        noting.rotate(R.data(), out.data(), out.data());
    }
    return given;
}

/// As JSON: the shortest digits that give the numbers back.
template <class T>
std::string json(const std::vector<T>& values) {
    return fmt::format("[{}]", fmt::join(values, ","));
}

/// [{order, count, signals, kernels: [{call, files, channels, rotations}]}]
template <class Language>
void write_turns(const std::filesystem::path& path) {
    using Number = typename Language::Number;
    std::vector<std::string> turns;
    for (const int order : Language::kOrders) {
        const std::vector<Problem> all = problems<Number>(order);
        std::vector<Number> signals;
        for (const Problem& problem : all)
            signals.insert(signals.end(), problem.signal.begin(), problem.signal.end());
        std::vector<std::string> kernels;
        for (const Call& call : Language::calls(order))
            kernels.push_back(fmt::format(R"({{"call":"{}","files":["{}"],"channels":{},"rotations":{}}})",
                                          call.text, fmt::join(call.files, "\",\""), call.channels,
                                          json(matrices<Number>(order, call, all))));
        turns.push_back(fmt::format(R"({{"order":{},"count":{},"signals":{},"kernels":[{}]}})", order,
                                    all.size(), json(signals), fmt::join(kernels, ",")));
    }
    std::ofstream file(path);
    if (!(file << fmt::format("[{}]\n", fmt::join(turns, ",\n"))))
        throw std::runtime_error(fmt::format("{}: cannot be written; choose another place", path.string()));
}

template <class Number>
std::vector<Number> read_values(const std::filesystem::path& path, std::size_t wanted) {
    std::vector<Number> values(wanted);
    const auto size = static_cast<std::streamsize>(wanted * sizeof(Number));
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(values.data()), size);
    if (file.gcount() != size || file.peek() != std::ifstream::traits_type::eof())
        throw std::runtime_error(fmt::format("{}: found another size, wanted {} bytes; run the kernels again",
                                             path.string(), size));
    return values;
}

template <class Language>
void compare(const std::filesystem::path& path) {
    using Number = typename Language::Number;
    std::size_t wanted = 0;
    for (const int order : Language::kOrders)
        wanted += problems<Number>(order).size() * Language::calls(order).size() * order * order;
    const std::vector<Number> values = read_values<Number>(path, wanted);
    const Number* next = values.data();
    bool is_met = true;
    for (const int order : Language::kOrders) {
        const std::vector<Problem> all = problems<Number>(order);
        std::vector<Contestant<Number>> contestants;
        for (const Call& call : Language::calls(order)) {
            contestants.push_back(contestant<Number>(
                order, call,
                [at = next, size = order * order](const Number*, const Number*, Number* out) mutable {
                    std::copy_n(at, size, out);
                    at += size;
                }));
            next += all.size() * order * order;
        }
        const auto worst =
            zonal::accuracy::worst_errors<Number>(zonal::oracle::Rotation(order), all, contestants);
        for (std::size_t k = 0; k < worst.size(); ++k) {
            const zonal::banner::Bound published =
                zonal::banner::bound(order, Language::calls(order)[k].published);
            const double bound =
                std::is_same_v<Number, float> ? published.float_bound : published.double_bound;
            const bool is_within = worst[k].error <= bound;
            fmt::print("  order {:<2} {:<60} {:.2g}, {:.2f} of its bound{}\n", order, contestants[k].name,
                       worst[k].error, worst[k].error / bound, is_within ? "" : "; worst: " + worst[k].name);
            is_met = is_met && is_within;
        }
    }
    std::fflush(stdout);  // before the error
    if (!is_met)
        throw std::runtime_error(fmt::format("{} exceeds the bounds that banners publish", Language::kName));
}

template <class Language>
bool run(const std::string& action, const std::string& path) {
    if (action == "write")
        write_turns<Language>(path);
    else if (action == "compare")
        compare<Language>(path);
    else
        return false;
    return true;
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    try {
        const bool is_understood =
            arguments.size() == 3 && ((arguments[0] == "wgsl" && run<Wgsl>(arguments[1], arguments[2])) ||
                                      (arguments[0] == "js" && run<JavaScript>(arguments[1], arguments[2])));
        if (!is_understood)
            throw std::runtime_error(
                fmt::format("found '{}', wanted: wgsl|js write TURNS.json | wgsl|js compare TURNED.bin",
                            fmt::join(arguments, " ")));
    } catch (const std::exception& problem) {
        fmt::print(stderr, "error: {}\n", problem.what());
        return 1;
    }
    return 0;
}
