#pragma once

#include <map>
#include <string>
#include <vector>

#include "graph/kernel.hpp"

namespace zonal::emit {

/// A second name for a kernel of the same unit.
struct Forward {
    std::string name;
    std::string target;
    std::string summary;
};

/// The published largest error of one kernel relative to the norm of its input, by type.
struct Bound {
    std::string float_text;
    std::string double_text;
};

/// Everything one generated file holds, ready to print in any language: kernels are optimized, texts are
/// final.
struct Unit {
    std::string name;     ///< "order4": namespace or prefix
    std::string command;  ///< the command that makes the same bytes again
    std::string table;    ///< path and hash of the lobe table
    std::string basis;    ///< the convention, one line
    std::string domain;   ///< the rotations that the bound holds for
    std::vector<std::string> sources;
    std::vector<graph::Kernel> kernels;
    std::vector<Forward> forwards;
    std::map<std::string, Bound> bounds;  ///< by kernel name; a kernel without one says so in the banner
};

}  // namespace zonal::emit
