#include "kernels/rotation_scalars.hpp"

#include <fmt/format.h>

namespace zonal::kernels {

using graph::Value;

graph::Array rotation_array() {
    return {"R", graph::Kind::rotation, 9, "row-major, dimensionless, orthonormal rows"};
}

Matrix3 rotation_rows(graph::Kernel& kernel) {
    Matrix3 rows;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            rows[i][j] = kernel.input(0, 3 * i + j);
            kernel.graph.set_name(rows[i][j].id, fmt::format("r{}{}", i, j));
        }
    }
    return rows;
}

Matrix3 orthonormalized(graph::Kernel& kernel, const Matrix3& rows) {
    kernel.graph.set_scope("orthonormal");
    const auto name = [&](Value value, const char* meaning, int i, int j) {
        kernel.graph.set_name(value.id, fmt::format("{}{}{}", meaning, i, j));
        return value;
    };
    Matrix3 half_defect;  // (I - RᵀR) / 2, symmetric
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
            Value defect{&kernel.graph, kernel.graph.constant(i == j ? 1 : 0)};
            for (int k = 0; k < 3; ++k) defect = defect - rows[k][i] * rows[k][j];
            half_defect[i][j] = half_defect[j][i] = name(graph::Number(0.5) * defect, "h", i, j);
        }
    }
    Matrix3 result;
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            Value entry = rows[i][j];
            for (int k = 0; k < 3; ++k) entry = entry + rows[i][k] * half_defect[k][j];
            result[i][j] = name(entry, "u", i, j);
        }
    }
    return result;
}

}  // namespace zonal::kernels
