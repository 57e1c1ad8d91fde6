#pragma once

#include "graph/kernel.hpp"

namespace zonal::graph {

/// Takes R and f, nine values each, and has done nothing yet: where tests of the graph begin.
inline Kernel empty_kernel() {
    Kernel kernel;
    kernel.name = "test";
    kernel.inputs = {{"R", Kind::rotation, 9, ""}, {"f", Kind::signal, 9, ""}};
    kernel.output = {"out", Kind::signal, 9, ""};
    return kernel;
}

}  // namespace zonal::graph
