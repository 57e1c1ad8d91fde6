#pragma once

#include <string>

namespace zonal::banner {

/// What the banner publishes for a kernel.
struct Bound {
    double float_bound = 0;
    double double_bound = 0;
    double float_apart = 0, double_apart = 0;  ///< without fused instructions
    double excess = 0;                         ///< for each unit of ‖R Rᵀ - I‖_F
    bool takes_mirrors = false;                ///< holds for det R = -1 too
};
/// Throws std::runtime_error naming order and kernel where it publishes none.
Bound bound(int order, const std::string& kernel);

/// What it publishes for a signal of several channels, which another kernel rotates. Throws likewise.
double float_bound_of_channels(int order, const std::string& kernel);

/// Whether the comment above a function that takes R and f says that det R may be -1. Throws where it says
/// nothing of det R.
bool comment_takes_mirrors(int order, const std::string& kernel);

/// What the banner says of one vector, and of every further one of the same rotation: "12 mul 3 add 4 fma 0
/// other".
struct Cost {
    std::string one, further;
};
Cost cost(int order, const std::string& kernel);
/// The same of C++ in another folder than that of the committed code.
Cost cost_in(const std::string& folder, int order, const std::string& kernel);

}  // namespace zonal::banner
