#pragma once

#include <map>
#include <string>
#include <vector>

#include "graph/kernel.hpp"

namespace zonal::emit {

/// The published largest error of one kernel relative to the norm of its input, by type, and what is added to
/// it for each unit of |R R^T - I|_F.
struct Bound {
    std::string float_text;
    std::string double_text;
    std::string excess_text;
};

/// A number that callers need to know at compile time.
struct Constant {
    std::string name;
    int value = 0;
    std::string meaning;
};

/// Everything one generated file holds, ready to print in any language: kernels are optimized, texts are
/// final.
struct Unit {
    std::string name;                 ///< "order4": namespace or prefix
    std::string file_stem;            ///< "order04": what names of files begin with
    std::string command;              ///< the command that makes the same bytes again
    std::vector<std::string> tables;  ///< path and hash of each lobe table; or that there is none
    std::string basis;                ///< the convention, one line
    std::vector<std::string> sources;
    std::vector<graph::Kernel> kernels;
    std::vector<Constant> constants;
    std::map<std::string, Bound> bounds;  ///< by kernel name; a kernel without one says so in the banner
};

}  // namespace zonal::emit
