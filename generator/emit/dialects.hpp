#pragma once

#include "emit/shader_functions.hpp"

namespace zonal::emit {

/// Desktop versions from 4.50 and ES 3.00 alike: no #version, no fma, no precise; highp.
inline const ShaderDialect kGlsl{"glsl", "highp float", "highp vec3", "floatBitsToUint", "uintBitsToFloat"};

/// Shader Model 5 and up.
inline const ShaderDialect kHlsl{"hlsl", "float", "float3", "asuint", "asfloat"};

}  // namespace zonal::emit
