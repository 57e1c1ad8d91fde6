#pragma once

// What property tests of compiled kernels share: small arithmetic on signals, and checks of one rotation.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "support/accuracy.hpp"
#include "support/compiled_kernels.hpp"

namespace zonal {

using cases::Matrix;

inline constexpr Matrix kIdentity{1, 0, 0, 0, 1, 0, 0, 0, 1};

template <class T>
double norm(const std::vector<T>& v) {
    double sum = 0;
    for (const T x : v) sum += static_cast<double>(x) * static_cast<double>(x);
    return std::sqrt(sum);
}

template <class T>
double distance(const std::vector<T>& a, const std::vector<T>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double difference = static_cast<double>(a[i]) - static_cast<double>(b[i]);
        sum += difference * difference;
    }
    return std::sqrt(sum);
}

template <class T>
std::array<T, 9> rounded(const Matrix& rotation) {
    std::array<T, 9> r;
    std::transform(rotation.begin(), rotation.end(), r.begin(),
                   [](double entry) { return static_cast<T>(entry); });
    return r;
}

/// A rotation as T has it.
template <class T>
oracle::Matrix3 as_given(const Matrix& rotation) {
    const std::array<T, 9> r = rounded<T>(rotation);
    oracle::Matrix3 given;
    std::copy(r.begin(), r.end(), given.begin());
    return given;
}

template <class T>
std::vector<T> rotated(RotateKernel<T> kernel, const Matrix& rotation, const std::vector<T>& f) {
    std::vector<T> out(f.size());
    kernel(rounded<T>(rotation).data(), f.data(), out.data());
    return out;
}

/// `rotate`: a signal's rotation by one matrix.
template <class Rotate>
void expect_bands_apart(int order, const std::vector<double>& f, Rotate rotate) {
    const std::vector<double> clean = rotate(f);
    for (const double bad :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
        for (int broken = 0; broken < order; ++broken) {
            std::vector<double> spoilt = f;
            spoilt[broken * broken] = bad;
            const std::vector<double> result = rotate(spoilt);
            for (int i = 0; i < order * order; ++i) {
                const bool is_in_band = broken * broken <= i && i < (broken + 1) * (broken + 1);
                if (is_in_band) continue;
                EXPECT_EQ(result[i], clean[i]) << "band " << broken << " leaked into " << i;
            }
            EXPECT_FALSE(std::isfinite(norm(result)));
        }
    }
}

template <class T>
void expect_denormals_within_4_n_squared(int order, const Matrix& rotation, const std::vector<double>& f,
                                         RotateKernel<T> rotate) {
    const T smallest = std::numeric_limits<T>::denorm_min();
    const int size = order * order;
    std::vector<T> tiny(size), out(size);
    std::vector<double> whole(size);
    for (int i = 0; i < size; ++i) {
        whole[i] = std::round(1000 * f[i]);
        tiny[i] = static_cast<T>(whole[i]) * smallest;
    }
    rotate(rounded<T>(rotation).data(), tiny.data(), out.data());
    const auto expected = oracle::Rotation(order)(as_given<T>(rotation), {whole.begin(), whole.end()});
    for (int i = 0; i < size; ++i)
        EXPECT_LE(std::abs(static_cast<oracle::Real>(out[i]) / smallest - expected[i]), 4 * size);
}

}  // namespace zonal
