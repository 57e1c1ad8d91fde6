#include "support/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

#include "support/case_count.hpp"

namespace zonal::accuracy {

namespace {

constexpr const char* kHardSignal = "hard signal";

template <class T>
oracle::Matrix3 as_given(const cases::Matrix& rotation) {
    oracle::Matrix3 given;
    for (int i = 0; i < 9; ++i) given[i] = static_cast<T>(rotation[i]);
    return given;
}

oracle::Real determinant(const oracle::Matrix3& r) {
    return r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) +
           r[2] * (r[3] * r[7] - r[4] * r[6]);
}

/// ‖out - expected‖₂ / ‖f‖₂ over elements first … last - 1. A vector of zeros must come out as zeros: any
/// difference counts in full. NaN counts as infinite.
template <class T>
double relative_error(const std::vector<T>& out, const std::vector<oracle::Real>& expected,
                      const std::vector<T>& f, int first, int last) {
    oracle::Real difference = 0, norm = 0;
    for (int i = first; i < last; ++i) {
        difference += (out[i] - expected[i]) * (out[i] - expected[i]);
        norm += static_cast<oracle::Real>(f[i]) * f[i];
    }
    const double error = static_cast<double>(std::sqrt(norm > 0 ? difference / norm : difference));
    return std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}

/// `name()`: what the error is of, put into words only where it is the largest yet.
template <class Name>
void keep_larger(double error, Name name, double& largest, std::string& name_of_largest) {
    if (error <= largest) return;
    largest = error;
    name_of_largest = name();
}

}  // namespace

template <class T>
Contestant<T> with_mirrors(int order, Contestant<T> kernel) {
    const auto rotate = kernel.rotate;
    kernel.rotate = [order, rotate](const T* R, const T* f, T* out) {
        oracle::Matrix3 given;
        std::copy(R, R + 9, given.begin());
        if (determinant(given) > 0) return rotate(R, f, out);
        T negative[9];
        std::transform(R, R + 9, negative, [](T entry) { return -entry; });
        rotate(negative, f, out);
        for (int l = 1; l < order; l += 2)
            for (int i = l * l; i < (l + 1) * (l + 1); ++i) out[i] = -out[i];
    };
    return kernel;
}

template <class T>
std::vector<Problem> problems(int order, int random_count, int thinning, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    std::vector<Problem> all;
    const auto add = [&](const std::string& name, const cases::Matrix& rotation, std::vector<double> signal) {
        const bool is_noisy = name.starts_with("orthonormal only");
        all.push_back({name, rotation, std::move(signal), is_noisy, name == kHardSignal});
    };
    for (int k = 0; k < random_count; ++k) {
        const cases::Matrix rotation = cases::random_rotation(random);
        add("random rotation", rotation, cases::random_signal(order, random));
    }
    std::map<std::string, int> seen;
    for (const cases::Case& hard : cases::hard_rotations<T>(random)) {
        const int always_taken = order <= 10 ? 100 : 33;
        const int number = seen[hard.name]++;
        if (number >= always_taken && number % thinning != 0) continue;
        add(hard.name, hard.rotation, cases::random_signal(order, random));
    }
    for (const std::vector<double>& f : cases::hard_signals(order, random))
        for (int k = 0; k < (thinning == 1 ? 20 : 3); ++k)
            add(kHardSignal, cases::random_rotation(random), f);
    std::map<std::string, int> met;
    std::erase_if(all, [&](const Problem& problem) { return !cases::takes(met[problem.name]++); });
    return all;
}

std::vector<Problem> tiny_tilts(int order, std::uint64_t seed, int signals) {
    std::mt19937_64 random(seed);
    std::vector<Problem> all;
    for (const cases::Case& tilt : cases::tiny_tilts(random))
        for (int k = 0; k < signals; ++k)
            all.push_back({tilt.name, tilt.rotation, cases::random_signal(order, random)});
    return all;
}

template <class T>
std::vector<Worst> worst_errors(const oracle::Rotation& exact, const std::vector<Problem>& problems,
                                const std::vector<Contestant<T>>& kernels) {
    if (problems.empty() || kernels.empty()) throw std::invalid_argument("nothing to judge");
    const int order = exact.order();
    std::vector<Worst> worst(kernels.size());
    std::vector<T> out(order * order);
    for (const Problem& problem : problems) {
        const oracle::Matrix3 given = as_given<T>(problem.rotation);
        const std::vector<T> f(problem.signal.begin(), problem.signal.end());
        const std::vector<oracle::Real> expected = exact(given, {f.begin(), f.end()});
        const double defect = static_cast<double>(oracle::orthonormality_error(given));
        T r[9];
        std::copy(given.begin(), given.end(), r);
        const auto name = [&] { return problem.name; };
        for (std::size_t k = 0; k < kernels.size(); ++k) {
            std::fill(out.begin(), out.end(), T(0));
            kernels[k].rotate(r, f.data(), out.data());
            Worst& w = worst[k];
            const double error = relative_error(out, expected, f, 0, order * order);
            keep_larger(error - kernels[k].excess * defect, name, w.error, w.name);
            if (problem.is_noisy) continue;
            const double excused = (order - 1) / 2.0 * defect;
            keep_larger(error - excused, name, w.error_of_rotations, w.name_of_rotations);
            if (problem.has_hard_signal) continue;
            for (int l = 1; l < order; ++l)
                keep_larger(
                    relative_error(out, expected, f, l * l, (l + 1) * (l + 1)) - excused,
                    [&] { return fmt::format("band {}, {}", l, problem.name); }, w.error_of_bands,
                    w.name_of_bands);
        }
    }
    return worst;
}

double contract(const std::string& kernel, int order, bool is_float) {
    struct Point {
        int order;
        double float_bound, double_bound;
    };
    static const std::vector<Point> rotate{{2, 1.2e-7, 3e-16},   {3, 2.8e-7, 6e-16}, {4, 8e-7, 1.5e-15},
                                           {5, 1.3e-6, 3.5e-15}, {6, 1.8e-6, 5e-15}, {8, 2e-6, 7e-15},
                                           {10, 2.5e-6, 8e-15},  {20, 5e-6, 3e-14}};
    static const std::vector<Point> accurate{{2, 1.2e-7, 3e-16},  {3, 1.8e-7, 5e-16}, {4, 2e-7, 6e-16},
                                             {5, 3e-7, 1e-15},    {6, 3e-7, 1.2e-15}, {8, 3.5e-7, 1.6e-15},
                                             {10, 4.5e-7, 2e-15}, {20, 1.2e-6, 5e-15}};
    // The contract has no row of blocks in double: that of rotate_accurate, which multiplies by them.
    static const std::vector<Point> blocks{{2, 1.5e-7, 3e-16}, {3, 2e-7, 5e-16},     {4, 2e-7, 6e-16},
                                           {5, 2.5e-7, 1e-15}, {6, 2.5e-7, 1.2e-15}, {8, 3e-7, 1.6e-15},
                                           {10, 4e-7, 2e-15},  {20, 1e-6, 5e-15}};
    static const std::vector<Point> zhf{{3, 6e-7, 2e-14}, {4, 1e-6, 3e-14}, {5, 2e-6, 4e-14},
                                        {6, 3e-6, 6e-14}, {8, 5e-6, 1e-13}, {10, 8e-6, 1e-13},
                                        {20, 3e-5, 1e-12}};
    static const std::map<std::string, const std::vector<Point>*> all{
        {"rotate", &rotate},        {"rotate_channels", &rotate}, {"rotate_tensor", &rotate},
        {"rotate_fewest", &rotate}, {"apply", &rotate},           {"rotate_accurate", &accurate},
        {"blocks", &blocks},        {"rotate_zhf", &zhf},         {"stable::rotate_zhf", &zhf}};
    const std::vector<Point>& points = *all.at(kernel);
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        const Point &a = points[k], &b = points[k + 1];
        if (order < a.order || order > b.order) continue;
        const double t = static_cast<double>(order - a.order) / (b.order - a.order);
        return is_float ? a.float_bound + t * (b.float_bound - a.float_bound)
                        : a.double_bound + t * (b.double_bound - a.double_bound);
    }
    throw std::out_of_range("no contract for this order");
}

template Contestant<float> with_mirrors(int, Contestant<float>);
template Contestant<double> with_mirrors(int, Contestant<double>);
template std::vector<Problem> problems<float>(int, int, int, std::uint64_t);
template std::vector<Problem> problems<double>(int, int, int, std::uint64_t);
template std::vector<Worst> worst_errors(const oracle::Rotation&, const std::vector<Problem>&,
                                         const std::vector<Contestant<float>>&);
template std::vector<Worst> worst_errors(const oracle::Rotation&, const std::vector<Problem>&,
                                         const std::vector<Contestant<double>>&);

}  // namespace zonal::accuracy
