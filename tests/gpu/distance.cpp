#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <random>

#include "gpu/vectors.hpp"
#include "support/banner.hpp"
#include "support/oracle.hpp"

namespace zonal::gpu {

namespace {

/// One channel of a vector.
struct Channel {
    const float* first = nullptr;
    int stride = 1;
    float operator[](int i) const { return first[i * stride]; }
};

/// Says what is wrong with one channel of one vector, or nothing.
using Judge = std::function<std::string(const float* R, Channel source, Channel got, Channel wanted)>;

double determinant(const float* r) {
    const auto minor = [&](int a, int b, int c, int d) {
        return static_cast<double>(r[a]) * r[d] - static_cast<double>(r[b]) * r[c];
    };
    return r[0] * minor(4, 5, 7, 8) - r[1] * minor(3, 5, 6, 8) + r[2] * minor(3, 4, 6, 7);
}

double orthonormality_error(const float* r) {
    oracle::Matrix3 matrix;
    std::copy(r, r + 9, matrix.begin());
    return static_cast<double>(oracle::orthonormality_error(matrix));
}

double norm(Channel values, int size) {
    double squares = 0;
    for (int i = 0; i < size; ++i)
        if (!std::isnan(values[i])) squares += static_cast<double>(values[i]) * values[i];
    return std::sqrt(squares);
}

/// Whether two vectors are further apart than allowed, or a NaN is not where it is wanted.
std::string too_far(Channel got, Channel wanted, int size, double allowed) {
    double squares = 0;
    for (int i = 0; i < size; ++i) {
        const double a = got[i], b = wanted[i];
        if (std::isnan(a) != std::isnan(b)) return fmt::format("value {} is {}, wanted {}", i, a, b);
        if (!std::isnan(a)) squares += (a - b) * (a - b);
    }
    if (std::sqrt(squares) <= allowed) return {};
    return fmt::format("{:.3g} apart, wanted at most {:.3g}", std::sqrt(squares), allowed);
}

/// What scalars or blocks make of a signal.
std::vector<float> turned(int order, const ReferenceKernel& kernel, Channel result,
                          const std::vector<float>& f) {
    std::vector<float> out(f.size());
    if (kernel.name == "prepare") {
        reference_kernel(order, "apply").run(result.first, f.data(), out.data());
        return out;
    }
    for (int l = 0; l < order; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            out[i] = static_cast<float>(std::transform_reduce(
                f.begin() + l * l, f.begin() + (l + 1) * (l + 1),
                result.first + l * (4 * l * l - 1) / 3 + (i - l * l) * (2 * l + 1), 0.0));
    return out;
}

/// Two turns that are both within the published bound; of any matrix that the bound is published for.
Judge judge_of_turns(int order, const ReferenceKernel& kernel, int channels) {
    const banner::Bound bound = banner::bound(order, bound_name(order, kernel, channels));
    std::mt19937_64 random(1);
    std::normal_distribution<float> normal;
    std::vector<float> probe(order * order);
    for (float& value : probe) value = normal(random);
    return [=](const float* R, Channel source, Channel got, Channel wanted) -> std::string {
        if (determinant(R) < 0 && !bound.takes_mirrors) return {};
        const int size = order * order;
        const double allowed = 2 * (bound.float_bound + bound.excess * orthonormality_error(R));
        if (kernel.turns_signal()) return too_far(got, wanted, size, allowed * norm(source, size));
        const std::vector<float> a = turned(order, kernel, got, probe),
                                 b = turned(order, kernel, wanted, probe);
        return too_far({a.data()}, {b.data()}, size, allowed * norm({probe.data()}, size));
    };
}

/// The matrix of a linear kernel, row-major, from what it makes of unit vectors.
std::vector<float> matrix_of(const ReferenceKernel& kernel, int inputs) {
    std::vector<float> matrix(static_cast<std::size_t>(inputs) * kernel.output_size), out(kernel.output_size);
    for (int j = 0; j < inputs; ++j) {
        std::vector<float> unit(inputs);
        unit[j] = 1;
        kernel.run(unit.data(), unit.data(), out.data());
        for (int i = 0; i < kernel.output_size; ++i) matrix[i * inputs + j] = out[i];
    }
    return matrix;
}

/// Two evaluations of sum_j M_ij f_j. Outputs share partial sums, and each of its terms enters an output
/// once: on its way through n terms it meets at most n - 1 sums and, before, between and behind them, n
/// factors, each rounded as a constant and as a product. So each is off by at most gamma(3 n - 1) |M| |f|,
/// whatever the order. Source: Higham 2002, "Accuracy and Stability of Numerical Algorithms", section 3.1.
Judge judge_of_sums(const ReferenceKernel& kernel) {
    const int inputs = kernel.has_signal() ? kernel.input_size : kernel.rotation_size;
    return [=, matrix = matrix_of(kernel, inputs)](const float*, Channel source, Channel got,
                                                   Channel wanted) -> std::string {
        for (int i = 0; i < kernel.output_size; ++i) {
            const float* row = matrix.data() + i * inputs;
            const auto terms = static_cast<double>(inputs - std::count(row, row + inputs, 0.0f));
            const double roundings = (3 * terms - 1) * 0x1p-24, gamma = roundings / (1 - roundings);
            double size = 0;
            for (int j = 0; j < inputs; ++j)
                if (!std::isnan(source[j])) size += std::abs(static_cast<double>(row[j]) * source[j]);
            const std::string message = too_far({got.first + i * got.stride},
                                                {wanted.first + i * wanted.stride}, 1, 2 * gamma * size);
            if (!message.empty()) return fmt::format("output {}: {}", i, message);
        }
        return {};
    };
}

}  // namespace

std::string bound_name(int order, const ReferenceKernel& kernel, int channels) {
    if (kernel.name == "prepare") return "apply";
    if (kernel.name == "stable_rotate_zhf") return "stable::rotate_zhf";
    // What `rotate` is in shaders: reference_order.cpp.
    if (kernel.name != "rotate" && kernel.name != "rotate_fewest") return kernel.name;
    return channels == 3 && order > 3 ? "rotate_channels" : "rotate_fewest";
}

std::string distance(int order, const ReferenceKernel& kernel, const Vectors& vectors,
                     const std::vector<float>& got, const std::vector<float>& wanted, int channels) {
    const Judge judge =
        kernel.makes_turns() ? judge_of_turns(order, kernel, channels) : judge_of_sums(kernel);
    const std::vector<float>& source = kernel.has_signal() ? vectors.inputs : vectors.rotations;
    const int inputs = kernel.has_signal() ? kernel.input_size : kernel.rotation_size;
    for (int k = 0; k < vectors.count; ++k) {
        for (int c = 0; c < channels; ++c) {
            const auto channel = [&](const std::vector<float>& values, int size) {
                return Channel{values.data() + static_cast<std::size_t>(k) * size * channels + c, channels};
            };
            const std::string message =
                judge(vectors.matrices.data() + 9 * k, channel(source, inputs),
                      channel(got, kernel.output_size), channel(wanted, kernel.output_size));
            if (!message.empty()) return fmt::format("vector {}, channel {}: {}", k, c, message);
        }
    }
    return {};
}

}  // namespace zonal::gpu
