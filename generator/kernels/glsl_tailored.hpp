#pragma once

#include "emit/file.hpp"
#include "emit/unit.hpp"
#include "kernels/lobes.hpp"

namespace zonal::kernels {

inline constexpr const char* kTailoredName = "rotate_tailored";

/// `rotate_tailored` of a unit that has the kernels `lobes` and `resample` of these lobes: GLSL 4.50 and ES
/// 3.20, since ES 3.00 has no cube-map arrays.
emit::File print_glsl_tailored(const emit::Unit& unit, const LobeSet& lobes);

}  // namespace zonal::kernels
