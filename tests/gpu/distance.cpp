#include <fmt/format.h>

#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include "gpu/vectors.hpp"
#include "support/banner.hpp"
#include "support/oracle.hpp"

namespace zonal::gpu {

namespace {

constexpr double kUnit = 0x1p-24;

/// How the banner calls a kernel whose file ends in `name`, in a form of so many channels.
std::string name_of_bound(int order, const std::string& name, int channels) {
    if (name == "prepare") return "apply";
    if (name == "stable_rotate_zhf") return "stable::rotate_zhf";
    return name == "rotate" && channels == 3 && order > 2 ? "rotate_channels" : name;
}

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

/// Kernels that make scalars or blocks: what those make of a signal. Others: the vector itself.
std::vector<float> turned(int order, const ReferenceKernel& kernel, const float* result,
                          const std::vector<float>& f) {
    std::vector<float> out(f.size());
    if (kernel.name == "prepare") {
        reference_kernel(order, "apply").run(result, f.data(), out.data());
        return out;
    }
    for (int l = 0; l < order; ++l)
        for (int i = l * l; i < (l + 1) * (l + 1); ++i)
            out[i] = static_cast<float>(
                std::transform_reduce(f.begin() + l * l, f.begin() + (l + 1) * (l + 1),
                                      result + l * (4 * l * l - 1) / 3 + (i - l * l) * (2 * l + 1), 0.0));
    return out;
}

/// Judges one channel of one vector.
std::string distance_of_turns(const float* got, const float* wanted, int size, int stride, double allowed,
                              double norm) {
    double apart = 0;
    for (int i = 0; i < size; ++i) {
        const double a = got[i * stride], b = wanted[i * stride];
        if (std::isnan(a) != std::isnan(b)) return fmt::format("value {} is {}, wanted {}", i, a, b);
        if (!std::isnan(a)) apart += (a - b) * (a - b);
    }
    if (std::sqrt(apart) <= allowed * norm) return {};
    return fmt::format("relative difference {:.3g}, wanted at most {:.3g}", std::sqrt(apart) / norm, allowed);
}

/// The matrix of a linear kernel, row-major, from what it makes of unit vectors.
std::vector<float> matrix_of(const ReferenceKernel& kernel) {
    const int inputs = kernel.has_signal() ? kernel.input_size : kernel.rotation_size;
    std::vector<float> matrix(static_cast<std::size_t>(inputs) * kernel.output_size), out(kernel.output_size);
    for (int j = 0; j < inputs; ++j) {
        std::vector<float> unit(inputs);
        unit[j] = 1;
        kernel.run(unit.data(), unit.data(), out.data());
        for (int i = 0; i < kernel.output_size; ++i) matrix[i * inputs + j] = out[i];
    }
    return matrix;
}

}  // namespace

std::string distance(int order, const ReferenceKernel& kernel, const Vectors& vectors,
                     const std::vector<float>& got, const std::vector<float>& wanted, int channels) {
    const bool is_turn = kernel.makes_turns(), is_first_step = is_turn && !kernel.turns_signal();
    const banner::Bound bound =
        is_turn ? banner::bound(order, name_of_bound(order, kernel.name, channels)) : banner::Bound{};
    const std::vector<float> matrix = is_turn ? std::vector<float>{} : matrix_of(kernel);
    const std::vector<float>& source = kernel.has_signal() ? vectors.inputs : vectors.rotations;
    const int inputs = kernel.has_signal() ? kernel.input_size : kernel.rotation_size;
    std::mt19937_64 random(1);
    std::normal_distribution<float> normal;
    std::vector<float> probe(order * order);
    for (float& value : probe) value = normal(random);

    for (int k = 0; k < vectors.count; ++k) {
        const float* R = vectors.matrices.data() + 9 * k;
        for (int c = 0; c < channels; ++c) {
            const float* f = source.data() + static_cast<std::size_t>(k) * inputs * channels + c;
            const auto at = static_cast<std::size_t>(k) * kernel.output_size * channels + c;
            std::string message;
            if (is_turn) {
                if (determinant(R) < 0 && !bound.takes_mirrors) continue;
                const double allowed = 2 * (bound.float_bound + bound.excess * orthonormality_error(R));
                double squares = 0;
                if (is_first_step) {
                    for (const float value : probe) squares += static_cast<double>(value) * value;
                    const auto a = turned(order, kernel, got.data() + at, probe),
                               b = turned(order, kernel, wanted.data() + at, probe);
                    message =
                        distance_of_turns(a.data(), b.data(), order * order, 1, allowed, std::sqrt(squares));
                } else {
                    for (int i = 0; i < inputs; ++i) {
                        const double value = f[i * channels];
                        if (!std::isnan(value)) squares += value * value;
                    }
                    message = distance_of_turns(got.data() + at, wanted.data() + at, kernel.output_size,
                                                channels, allowed, std::sqrt(squares));
                }
            } else {
                for (int i = 0; i < kernel.output_size && message.empty(); ++i) {
                    double allowed = 0;
                    for (int j = 0; j < inputs; ++j) {
                        const double term =
                            std::abs(static_cast<double>(matrix[i * inputs + j]) * f[j * channels]);
                        if (!std::isnan(term)) allowed += 2 * inputs * kUnit * term;
                    }
                    message = distance_of_turns(got.data() + at + i * channels,
                                                wanted.data() + at + i * channels, 1, channels, allowed, 1);
                }
            }
            if (!message.empty()) return fmt::format("vector {}, channel {}: {}", k, c, message);
        }
    }
    return {};
}

}  // namespace zonal::gpu
