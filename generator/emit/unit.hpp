#pragma once

#include <functional>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "bounds/bound.hpp"
#include "graph/kernel.hpp"

namespace zonal::emit {

/// In which arithmetic a language runs, and so which bounds it publishes.
enum class Arithmetic {
    cpp,         ///< float or double, fused or apart
    javascript,  ///< double, apart
    shader       ///< float, fused or apart as the compiler likes, quotients and roots not exact
};

/// A number that callers need to know at compile time.
struct Constant {
    std::string name;
    int value = 0;
    std::string meaning;
};

/// The kernels of one order, ready to print in any language, one a file: kernels are optimized, texts are
/// final.
struct Unit {
    std::string name;    ///< "order4": namespace or prefix
    std::string folder;  ///< "order04": of its files
    std::string basis;   ///< the convention, one line
    std::vector<graph::Kernel> kernels;
    std::vector<Constant> constants;
    Arithmetic arithmetic = Arithmetic::cpp;
    std::map<std::string, Bound> bounds;  ///< by kernel; one without says so in its banner
    /// The lobe tables that a kernel is made of, path and hash, by kernel; none where it needs none.
    std::map<std::string, std::vector<std::string>> tables;
    /// The command that makes the file of a kernel again, by its plain name; empty: that of all kernels.
    std::function<std::string(const std::string& kernel)> command;
    /// Plain names of the kernels to print; empty: all.
    std::set<std::string> wanted;

    bool wants(const std::string& kernel) const { return wanted.empty() || wanted.contains(kernel); }
};

}  // namespace zonal::emit
