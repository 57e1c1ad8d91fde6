#pragma once

#include <string>

namespace zonal {

/// Largest errors of a kernel relative to the norm of its input, as decimals, where R is orthonormal.
/// Measured ones are the largest error met times 1.5.
struct Bound {
    std::string float_text, double_text;    ///< with fused instructions
    std::string float_apart, double_apart;  ///< a product and a sum for each: C++ without them, JavaScript
    std::string shader;  ///< in float, fused or not, quotients and roots as inexact as GLSL and Vulkan allow
    std::string excess_text;  ///< what is added for each unit of |R R^T - I|_F
    /// The same by a first-order analysis of rounding; empty where there is none (bounds/derived.hpp).
    std::string float_derived = {}, double_derived = {}, float_apart_derived = {}, double_apart_derived = {};
};

}  // namespace zonal
