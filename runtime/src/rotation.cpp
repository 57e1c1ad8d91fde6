#include "zonal/rotation.hpp"

#include <fmt/format.h>

#include "zonal/error.hpp"

namespace zonal::detail {

void throw_not_orthonormal(double error, double tolerance) {
    throw Error({.field = "rotation: ||R R^T - I||",
                 .found = fmt::format("{:.9g}", error),
                 .wanted = fmt::format("at most {:.9g}", tolerance),
                 .next_step = "orthonormalise the matrix or raise the tolerance"});
}

void throw_not_finite(int row, int column, double value) {
    throw Error({.field = fmt::format("rotation: value at row {}, column {}", row, column),
                 .found = fmt::format("{}", value),
                 .wanted = "a finite number",
                 .next_step = "repair the matrix where it is made"});
}

}  // namespace zonal::detail
