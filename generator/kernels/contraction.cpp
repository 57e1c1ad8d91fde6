// Low bands as tensors: f_l(ω) = T(ω, …, ω) with T symmetric and traceless, so that f'(ω) = f(Rᵀω) has the
// tensor T'_{jk…} = T(r_j, r_k, …), r_j the rows of R.
//
// Band 1 is a vector. Band 2: S' = R S Rᵀ needs two products S r_z, S r_x and five dot products, for its
// trace is known; adding a multiple of I to S changes S' by the same, which frees one entry of S. Band 3: two
// contractions with r_z, r_x leave matrices, three with rows leave vectors, seven dot products are all of T'.
// Both hold as far as R Rᵀ = I. Read directly, each harmonic of order |m| = 2, 3 is the difference it is by
// definition, with nothing inferred but one entry of T': what noise in R then costs is tested
// (graph_noise_test). Nothing is divided, so there is no pole; every step is linear in each row, so a mirror
// is as good as a rotation.
#include "kernels/contraction.hpp"

#include <fmt/format.h>

#include <array>

namespace zonal::kernels {

namespace {

using graph::Number;
using graph::Value;

/// Row · vector, one product a line: see graph::Value.
Value dot(const Vector3& row, const Vector3& v) {
    Value sum = row[0] * v[0];
    sum = sum + row[1] * v[1];
    return sum + row[2] * v[2];
}

/// addend + row · vector.
Value dot_onto(Value addend, const Vector3& row, const Vector3& v) {
    Value sum = addend;
    for (int i = 0; i < 3; ++i) sum = sum + row[i] * v[i];
    return sum;
}

/// row · vector - other row · other vector.
Value difference(const Vector3& row, const Vector3& v, const Vector3& other_row, const Vector3& u) {
    Value sum = dot(row, v);
    for (int i = 0; i < 3; ++i) sum = sum - other_row[i] * u[i];
    return sum;
}

/// A symmetric matrix.
struct Symmetric {
    Value xx, xy, xz, yy, yz, zz;
    Vector3 times(const Vector3& r) const {
        return {dot(r, {xx, xy, xz}), dot(r, {xy, yy, yz}), dot(r, {xz, yz, zz})};
    }
};

void build_band_1(graph::Kernel& kernel, const Matrix3& rows) {
    // Coefficients 1, 2, 3 belong to y, z, x.
    constexpr std::array<int, 3> kAxis{1, 2, 0};
    const Vector3 f{kernel.input(1, 3), kernel.input(1, 1), kernel.input(1, 2)};
    for (int i = 0; i < 3; ++i) kernel.store(1 + i, dot(rows[kAxis[i]], f), 1);
}

/// S = [a f4 f7; f4 0 f5; f7 f5 c] in units where y_2^{-2} is xy, a = 2 f8, c = f8 + √3 f6: the entry yy was
/// shifted to 0.
void build_band_2(graph::Kernel& kernel, const Matrix3& rows) {
    const auto& [x, y, z] = rows;
    const Value f4 = kernel.input(1, 4), f5 = kernel.input(1, 5), f6 = kernel.input(1, 6),
                f7 = kernel.input(1, 7), f8 = kernel.input(1, 8);
    const Number root_3 = sqrt(Number(3));
    const Value a = f8 + f8;
    const Value c = root_3 * f6 + f8;
    const auto image = [&](const Vector3& row) {
        Vector3 v;
        v[0] = row[0] * a;
        v[0] = v[0] + row[1] * f4;
        v[0] = v[0] + row[2] * f7;
        v[1] = row[0] * f4;
        v[1] = v[1] + row[2] * f5;
        v[2] = row[0] * f7;
        v[2] = v[2] + row[1] * f5;
        v[2] = v[2] + row[2] * c;
        return v;
    };
    const Vector3 w = image(z), v = image(x);
    // S'zz - c and S'xx, whose shifts are undone by c and by the trace.
    const Value t = dot_onto(-c, z, w);
    const Value half_t = Number(0.5) * t - f8;
    kernel.store(4, dot(y, v), 2);
    kernel.store(5, dot(y, w), 2);
    kernel.store(6, (root_3 / 2) * t + f6, 2);
    kernel.store(7, dot(x, w), 2);
    kernel.store(8, dot_onto(half_t, x, v), 2);
}

/// S in the same units, no entry shifted.
void build_band_2_directly(graph::Kernel& kernel, const Matrix3& rows) {
    const auto& [x, y, z] = rows;
    const Value f4 = kernel.input(1, 4), f5 = kernel.input(1, 5), f6 = kernel.input(1, 6),
                f7 = kernel.input(1, 7), f8 = kernel.input(1, 8);
    const Number root_3 = sqrt(Number(3));
    const Symmetric s{f8 - (1 / root_3) * f6, f4, f7, -f8 - (1 / root_3) * f6, f5, (2 / root_3) * f6};
    const Vector3 w = s.times(z), v = s.times(x), u = s.times(y);
    kernel.store(4, dot(y, v), 2);
    kernel.store(5, dot(y, w), 2);
    kernel.store(6, (root_3 / 2) * dot(z, w), 2);
    kernel.store(7, dot(x, w), 2);
    kernel.store(8, Number(0.5) * difference(x, v, y, u), 2);
}

/// The tensor in units where the coefficient of y_3^{±3}'s leading monomial is 1: y_3^3 = x³ - 3xy²,
/// y_3^2 = √6 (x² - y²) z, y_3^1 = √(3/5) x (4z² - x² - y²), y_3^0 = √(2/5) z (2z² - 3x² - 3y²).
void build_band_3(graph::Kernel& kernel, const Matrix3& rows, Reading reading) {
    const auto& [x, y, z] = rows;
    const auto f = [&](int m) { return kernel.input(1, 12 + m); };
    const Number n0 = sqrt(Number(2) / 5), n1 = sqrt(Number(3) / 5), n2 = sqrt(Number(6));

    // Seven entries are all of T; the others follow from T_xxi + T_yyi + T_zzi = 0. One product a line:
    // compilers differ in the order of two.
    const Value zzz = (2 * n0) * f(0);
    const Value zzx = (4 * n1 / 3) * f(1);
    const Value zzy = (4 * n1 / 3) * f(-1);
    const Value xyz = (n2 / 3) * f(-2);
    const Value zxx_trace = Number(-0.5) * zzz;
    const Value zxx = (n2 / 3) * f(2) + zxx_trace;
    const Value zyy = -(zxx + zzz);
    const Value xxx_trace = Number(-0.75) * zzx;
    const Value xxx = f(3) + xxx_trace;
    const Value xyy = -(xxx + zzx);
    const Value xxy_trace = Number(-0.25) * zzy;
    const Value xxy = f(-3) + xxy_trace;
    const Value yyy = -(xxy + zzy);

    // T(row), whose zz is known by the trace.
    const auto contracted = [&](const Vector3& r) {
        Symmetric s;
        s.xx = dot(r, {xxx, xxy, zxx});
        s.xy = dot(r, {xxy, xyy, xyz});
        s.xz = dot(r, {zxx, xyz, zzx});
        s.yy = dot(r, {xyy, yyy, zyy});
        s.yz = dot(r, {xyz, zyy, zzy});
        s.zz = -(s.xx + s.yy);
        return s;
    };
    const Symmetric a = contracted(z), b = contracted(x);
    const Vector3 w = a.times(z), v = a.times(x), u = b.times(x);

    const Value zzz_turned = dot(z, w), zzx_turned = dot(x, w), zzy_turned = dot(y, w);
    const Value zxx_turned = dot(x, v), xyz_turned = dot(y, v);
    const Value xxx_turned = dot(x, u), xxy_turned = dot(y, u);
    kernel.store(9, xxy_turned + Number(0.25) * zzy_turned, 3);
    kernel.store(10, (3 / n2) * xyz_turned, 3);
    kernel.store(11, (3 / (4 * n1)) * zzy_turned, 3);
    kernel.store(12, (1 / (2 * n0)) * zzz_turned, 3);
    kernel.store(13, (3 / (4 * n1)) * zzx_turned, 3);
    if (reading == Reading::by_trace) {
        kernel.store(14, (3 / n2) * (zxx_turned + Number(0.5) * zzz_turned), 3);
        kernel.store(15, xxx_turned + Number(0.75) * zzx_turned, 3);
    } else {
        const Value xyy_turned = dot(y, b.times(y));
        const Value quarter = Number(0.25) * xxx_turned;
        kernel.store(14, (3 / (2 * n2)) * difference(x, v, y, a.times(y)), 3);
        kernel.store(15, quarter - Number(0.75) * xyy_turned, 3);
    }
}

}  // namespace

// With determinant +1 an antisymmetric matrix may be added to S: it is a vector, turns as one, and R itself
// holds the components that undo it. M = [2f8 2f4 f7; 0 0 0; f7 2f5 c]; the factors 2 go to the rows of R.
void build_proper_contraction_band_2(graph::Kernel& kernel, const Matrix3& rows) {
    kernel.graph.set_scope("b2");
    const auto& [x, y, z] = rows;
    const Value f4 = kernel.input(1, 4), f5 = kernel.input(1, 5), f6 = kernel.input(1, 6),
                f7 = kernel.input(1, 7), f8 = kernel.input(1, 8);
    const Number root_3 = sqrt(Number(3));
    const Value c = root_3 * f6 + f8;
    struct Image {
        Value p, q;
    };
    const auto image = [&](const Vector3& row) {
        const Value twice_0 = row[0] + row[0], twice_1 = row[1] + row[1];
        const Value p = dot({twice_0, twice_1, row[2]}, {f8, f4, f7});
        return Image{p, dot({row[0], twice_1, row[2]}, {f7, f5, c})};
    };
    const Image of_z = image(z), of_x = image(x);
    const auto form = [](Value addend, const Vector3& row, const Image& image_of_row) {
        const Value sum = addend + row[0] * image_of_row.p;
        return sum + row[2] * image_of_row.q;
    };
    // What the antisymmetric part adds to an entry (row, other row) is undone by the third row.
    const auto undone_by = [&](const Vector3& row) {
        const Value product = row[0] * f5;
        return row[2] * f4 - product;
    };
    const Value by_x = undone_by(x), by_y = undone_by(y), by_z = undone_by(z);
    const Value t = form(-c, z, of_z);
    const Value half_t = Number(0.5) * t - f8;
    kernel.store(4, form(by_z, y, of_x), 2);
    kernel.store(5, form(-by_x, y, of_z), 2);
    kernel.store(6, (root_3 / 2) * t + f6, 2);
    kernel.store(7, form(by_y, x, of_z), 2);
    kernel.store(8, form(half_t, x, of_x), 2);
}

void build_contraction_band(graph::Kernel& kernel, const Matrix3& rows, int l, Reading reading) {
    kernel.graph.set_scope(fmt::format("b{}", l));
    switch (l) {
        case 1:
            return build_band_1(kernel, rows);
        case 2:
            return reading == Reading::by_trace ? build_band_2(kernel, rows)
                                                : build_band_2_directly(kernel, rows);
        default:
            return build_band_3(kernel, rows, reading);
    }
}

}  // namespace zonal::kernels
