#include "zonal/rotation.hpp"

#include <cmath>
#include <limits>

#include "text.hpp"
#include "zonal/error.hpp"

namespace zonal {

double orthonormality_error(const RotationMatrix<double>& rotation) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            if (!detail::is_finite(rotation(i, j))) return std::numeric_limits<double>::quiet_NaN();
            double product = i == j ? -1 : 0;
            for (int k = 0; k < 3; ++k) product += rotation(i, k) * rotation(j, k);
            sum += product * product;
        }
    }
    return std::sqrt(sum);
}

}  // namespace zonal

namespace zonal::detail {

void throw_not_orthonormal(double error, double tolerance) {
    throw Error({.field = "rotation: ||R R^T - I||",
                 .found = rounded_up(error, 9),
                 .wanted = joined("at most ", rounded(tolerance, 9)),
                 .next_step = "orthonormalise the matrix or raise the tolerance"});
}

void throw_not_finite(int row, int column, double value) {
    throw Error({.field = joined("rotation: value at row ", row, ", column ", column),
                 .found = text_of(value),
                 .wanted = "a finite number",
                 .next_step = "repair the matrix where it is made"});
}

}  // namespace zonal::detail
