#pragma once

#include <vector>

#include "emit/file.hpp"
#include "emit/unit.hpp"

namespace zonal::emit {

/// Prints `rotate` and `rotate_accurate` as ES modules, FOLDER/KERNEL.mjs, on arrays or typed arrays of
/// numbers: KERNEL(R, f, out, fAt, outAt), and KERNEL_rgb on interleaved triples, which computes what depends
/// on R once for `count` vectors.
std::vector<File> print_js(const Unit& unit);

}  // namespace zonal::emit
