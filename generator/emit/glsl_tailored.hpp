#pragma once

#include <string>
#include <vector>

#include "emit/file.hpp"
#include "emit/unit.hpp"

namespace zonal::emit {

/// How a signal that is tabulated in cube maps is sampled: what signal-tailored rotation adds to the kernels
/// `lobes` and `resample` of a unit.
struct TailoredRotation {
    /// A band that is looked up: its expansion is a layer of the cube-map array, in the order of this list.
    struct SampledBand {
        int band = 0;
        int first_sample = 0;  ///< of the band, in the input of `resample`
        int first_output = 0;  ///< of the band, in its output
        int output_count = 0;
        std::vector<int> lobes;  ///< looked up, one a sample, by number in the output of `lobes`
    };
    std::vector<SampledBand> bands;
    /// Turns the bands that are not looked up: (R, their coefficients) -> the first elements of the output.
    graph::Kernel rotate_low;
};

inline constexpr const char* kTailoredName = "rotate_tailored";

/// Prints `rotate_tailored` of a unit that has the kernels `lobes` and `resample`: GLSL 4.50 and ES 3.20,
/// since ES 3.00 has no cube-map arrays.
File print_glsl_tailored(const Unit& unit, const TailoredRotation& rotation);

}  // namespace zonal::emit
