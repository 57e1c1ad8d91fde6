#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "bounds/bound.hpp"
#include "kernels/order_kernels.hpp"

namespace zonal {

/// An entry of a file of bounds (generator/bounds/README.md says how they are measured).
struct MeasuredBound {
    int order = 0;
    std::string body;                  ///< hash of the arithmetic that it is of
    std::vector<std::string> kernels;  ///< that had this body when it was measured: for readers
    Bound bound;                       ///< what is measured of it
};

/// A bound as it is published: two digits, rounded up.
std::string rounded_up(double bound);

/// The project's own file: `bounds/bounds.json` beside the folder of tables.
std::filesystem::path bounds_file();

/// Throws `UserError` naming file, field, value and next step.
std::vector<MeasuredBound> read_bounds(const std::filesystem::path& path);

/// The bounds of an order's kernels by full name, those of the very arithmetic that they have, derived ones
/// beside them. Throws `UserError` where a kernel has none, but for one of a table that somebody chose, which
/// nobody has measured.
std::map<std::string, Bound> published_bounds(const OrderKernels& order);

}  // namespace zonal
