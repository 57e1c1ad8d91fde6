// Every entry by the neighbours of dense_blocks.cpp: inner columns of band l from the same column of band
// l-1, outer ones from the columns beside, in the rows nearer to 0 by the inverse rotation, whose matrices
// are transposed. Coefficients are a factor of the row times one of the column, so that the rows of band l
// are sums of five rows of band l-1, and a loop over columns runs on whole registers.
#include "kernels/dense_recursion.hpp"

#include <fmt/format.h>

#include <functional>

#include "kernels/dense_blocks.hpp"

namespace zonal::kernels {

namespace {

constexpr int kLastRecursionBand = 19;

const char* const kLoops = R"(#if defined(__GNUC__) || defined(_MSC_VER)
#define ZONAL_RESTRICT __restrict
#else
#define ZONAL_RESTRICT
#endif

template <class T>
using constant_of = std::conditional_t<is_single<T>::value, float, double>;

// A row of band l is a sum of five rows of band l - 1, each times a factor and row i of band 1,
// whose entries are r[3 (i + 1) + j + 1] for orders i, j = -1, 0, 1, that is y, z, x.
template <class C>
struct RowOfBandBefore {
    int i, row;
    C factor;
};

// Ivanic and Ruedenberg 1996, eq. 8.1 and Table 2, without the column's factor.
template <class C>
ZONAL_INLINE void rows_before(int l, int m, RowOfBandBefore<C>* terms) {
    const int k = m < 0 ? -m : m, sign = m < 0 ? -1 : 1;
    const C root_2 = C(1.4142135623730951), none = C(0);
    const C u = k < l ? RecursionRoots<C>::product(l, k) : none;
    const C v = RecursionRoots<C>::consecutive(l + k) / 2;
    const C w = RecursionRoots<C>::consecutive(l - k) / -2;
    const bool is_last = k >= l - 1;
    terms[0] = {0, k < l ? m : 0, u};
    if (m == 0) {
        terms[1] = {1, 1, -root_2 * v};
        terms[2] = {-1, -1, -root_2 * v};
        terms[3] = terms[4] = {0, 0, none};
        return;
    }
    const C first = k == 1 ? root_2 * v : v, second = k == 1 ? none : v;
    terms[1] = {sign, k - 1, first};
    terms[2] = {-sign, 1 - k, m > 0 ? -second : second};
    terms[3] = {sign, is_last ? 0 : k + 1, is_last ? none : m > 0 ? w : -w};
    terms[4] = {-sign, is_last ? 0 : -k - 1, is_last ? none : w};
}

// Row m of band l in its columns |n| <= most; `before`: band l - 1, `factors`: the columns' at n.
template <class T>
ZONAL_INLINE void inner_row(int l, int m, int most, const T* r, const T* ZONAL_RESTRICT before,
                            const T* ZONAL_RESTRICT factors, T* ZONAL_RESTRICT row) {
    RowOfBandBefore<constant_of<T>> terms[5];
    rows_before(l, m, terms);
    const auto part = [&](int k) { return T(terms[k].factor) * r[3 * terms[k].i + 4]; };
    const T a = part(0), b = part(1), c = part(2), d = part(3), e = part(4);
    const auto row_of = [&](int k) {
        return before + (terms[k].row + l - 1) * (2 * l - 1) + l - 1;
    };
    const T *const A = row_of(0), *const B = row_of(1), *const C = row_of(2), *const D = row_of(3),
            *const E = row_of(4);
    for (int n = -most; n <= most; ++n)
        row[n] = factors[n] * fma(a, A[n], fma(b, B[n], fma(c, C[n], fma(d, D[n], e * E[n]))));
}

// Row m of band l in its columns from <= |n| <= to, by those of band l - 1 beside them.
template <class T>
ZONAL_INLINE void outer_row(int l, int m, int from, int to, const T* r,
                            const T* ZONAL_RESTRICT before, const T* ZONAL_RESTRICT factors,
                            T* ZONAL_RESTRICT row) {
    RowOfBandBefore<constant_of<T>> terms[5];
    rows_before(l, m, terms);
    T plus[5] = {}, minus[5] = {};
    const T* rows[5];
    for (int k = 0; k < 5; ++k) {
        plus[k] = T(terms[k].factor) * r[3 * terms[k].i + 5];
        minus[k] = T(terms[k].factor) * r[3 * terms[k].i + 3];
        rows[k] = before + (terms[k].row + l - 1) * (2 * l - 1) + l - 1;
    }
    const auto sum = [&](const T* parts, int n) {
        const T from_d = fma(parts[3], rows[3][n], parts[4] * rows[4][n]);
        const T from_c = fma(parts[2], rows[2][n], from_d);
        return fma(parts[0], rows[0][n], fma(parts[1], rows[1][n], from_c));
    };
    for (int n = from; n <= to; ++n) {
        row[n] = factors[n] * (sum(plus, n - 1) - sum(minus, 1 - n));
        row[-n] = factors[n] * (sum(plus, 1 - n) + sum(minus, n - 1));
    }
}

// The blocks of one rotation, band by band up to N - 1.
template <int N, class T>
struct DenseRecursion {
    static constexpr int kSize = (2 * N - 1) * (2 * N - 1);
    T r[9], inverse[9];
    T blocks[2][kSize], transposes[2][kSize];
    int l = 0;

    // R by rows x, y, z. Begins with band 1.
    ZONAL_INLINE void begin(const T* R) {
        const int axes[] = {1, 2, 0};
        l = 1;
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) {
                r[3 * i + j] = blocks[1][3 * i + j] = R[3 * axes[i] + axes[j]];
                inverse[3 * j + i] = transposes[1][3 * j + i] = R[3 * axes[i] + axes[j]];
            }
    }
    // Row-major (2l+1)^2, and by columns.
    ZONAL_INLINE const T* block() const { return blocks[l % 2]; }
    ZONAL_INLINE const T* by_columns() const { return transposes[l % 2]; }

    ZONAL_INLINE void next() {
        const T* const before = block();
        const T* const before_by_columns = by_columns();
        ++l;
        const int most = MOST_INNER;
        T* const rows = blocks[l % 2];
        T* const columns = transposes[l % 2];
        const auto at = [&](T* matrix, int m) { return matrix + (m + l) * (2 * l + 1) + l; };
        using C = constant_of<T>;
        T factors_at[2 * N - 1];
        T* const factors = factors_at + l;
        for (int n = 0; n <= l; ++n)
            factors[n] = factors[-n] = T(n <= most ? RecursionRoots<C>::over_product(l, n)
                                                   : RecursionRoots<C>::over_consecutive(l + n));
        for (int m = -l; m <= l; ++m) inner_row(l, m, most, r, before, factors, at(rows, m));
        for (int k = most + 1; k <= l; ++k) {
            for (const int m : {-k, k}) {
                outer_row(l, m, most + 1, k, r, before, factors, at(rows, m));
                // Rows of the inverse's matrix are columns.
                inner_row(l, m, most, inverse, before_by_columns, factors, at(columns, m));
                if (k == most + 1) continue;
                outer_row(l, m, most + 1, k - 1, inverse, before_by_columns, factors,
                          at(columns, m));
            }
        }
        // What one has the other takes.
        for (int m = -l; m <= l; ++m)
            for (int n = -most; n <= most; ++n) at(columns, n)[m] = at(rows, m)[n];
        for (int k = most + 1; k <= l; ++k) {
            for (const int n : {-k, k}) {
                T* const column = at(columns, n);
                for (int m = 1 - k; m < k; ++m) at(rows, m)[n] = column[m];
                for (int m = k; m <= l; ++m) {
                    column[m] = at(rows, m)[n];
                    column[-m] = at(rows, -m)[n];
                }
            }
        }
    }

    // A band of a signal times the block; `out` may be `f`.
    template <class V>
    ZONAL_INLINE void rotate(const V* f, V* out) const {
        const T* column = by_columns();
        const int width = 2 * l + 1;
        V sums[2 * N - 1];
        for (int i = 0; i < width; ++i) sums[i] = column[i] * f[0];
        for (int j = 1; j < width; ++j) {
            column += width;
            for (int i = 0; i < width; ++i) sums[i] = fma(column[i], f[j], sums[i]);
        }
        for (int i = 0; i < width; ++i) out[i] = sums[i];
    }
};
)";

/// A function of C that reads a table of constants.
std::string table(const std::string& head, const std::string& index, int size,
                  const std::function<graph::Number(int)>& value) {
    std::string text = fmt::format("    {} {{\n        static constexpr C values[] = {{", head);
    for (int k = 0; k < size; ++k)
        text +=
            fmt::format("{}C({:.17g}),", k % 3 == 0 ? "\n            " : " ", static_cast<double>(value(k)));
    text.pop_back();
    return text + fmt::format("}};\n        return values[{}];\n    }}\n", index);
}

/// Factors of rows and of columns: square roots of products of whole numbers.
std::string roots() {
    const auto of_consecutive = [](int j) { return sqrt(graph::Number(j * (j - 1))); };
    const auto of_product = [](int at) {
        int l = 0;
        while ((l + 1) * (l + 2) / 2 <= at) ++l;
        const int m = at - l * (l + 1) / 2;
        return sqrt(graph::Number((l + m) * (l - m)));
    };
    const auto inverse = [](const graph::Number& root) {
        return root == 0 ? graph::Number(0) : graph::Number(1 / root);
    };
    constexpr int kPairs = 2 * kLastRecursionBand + 1,
                  kProducts = (kLastRecursionBand + 1) * (kLastRecursionBand + 2) / 2;
    const char* const of_band = "l * (l + 1) / 2 + m";
    return "// Roots of whole numbers, for bands up to 19. C: float or double.\ntemplate <class C>\n"
           "struct RecursionRoots {\n    // sqrt(j (j - 1)), 0 <= j, and what divides by it\n" +
           table("static ZONAL_INLINE C consecutive(int j)", "j", kPairs, of_consecutive) +
           table("static ZONAL_INLINE C over_consecutive(int j)", "j", kPairs,
                 [&](int j) { return inverse(of_consecutive(j)); }) +
           "    // sqrt((l + m) (l - m)), 0 <= m <= l, and what divides by it\n" +
           table("static ZONAL_INLINE C product(int l, int m)", of_band, kProducts, of_product) +
           table("static ZONAL_INLINE C over_product(int l, int m)", of_band, kProducts,
                 [&](int at) { return inverse(of_product(at)); }) +
           "};\n\n";
}

std::string support() {
    std::string loops = kLoops;
    const std::string most = "MOST_INNER";
    loops.replace(loops.find(most), most.size(), fmt::format("{} * l / 10", kInnerTenths));
    return roots() + loops;
}

/// Of the bands' blocks, as the loops do it: the padded terms of short rows too.
graph::Counts count_of_blocks(int order) {
    graph::Counts counts;
    for (int l = 2; l < order; ++l) {
        const int most = kInnerTenths * l / 10, outer = l - most;
        const int inner_rows = 2 * l + 1 + 2 * outer, columns = 2 * most + 1;
        const int outer_rows = 2 * outer + 2 * (outer - 1), pairs = 2 * outer * outer;
        counts.mul += inner_rows * (5 + 2 * columns) + outer_rows * 10 + pairs * (4 + 2);
        counts.fma += inner_rows * 4 * columns + pairs * 4 * 4;
        counts.add += 2 * pairs;
    }
    return counts;
}

graph::Counts count_of_products(int order) {
    graph::Counts counts;
    for (int l = 1; l < order; ++l) {
        counts.mul += 2 * l + 1;
        counts.fma += (2 * l + 1) * 2 * l;
    }
    return counts;
}

graph::Loops loops(const std::string& body, const graph::Counts& per_vector, int order) {
    static const std::string text = support();
    return {"dense_recursion", text, body, {count_of_blocks(order), per_vector}};
}

}  // namespace

graph::Loops loops_of_blocks(int order) {
    return loops(
        fmt::format("    DenseRecursion<{0}, T> recursion;\n"
                    "    *dense++ = T(1.0);\n"
                    "    recursion.begin(R);\n"
                    "    for (int l = 1; l < {0}; ++l) {{\n"
                    "        if (l > 1) recursion.next();\n"
                    "        const T* const block = recursion.block();\n"
                    "        for (int k = 0; k < (2 * l + 1) * (2 * l + 1); ++k) *dense++ = block[k];\n"
                    "    }}\n",
                    order),
        {}, order);
}

graph::Loops loops_of_rotation(int order) {
    return loops(fmt::format("    DenseRecursion<{0}, T> recursion;\n"
                             "    out[0] = f[0];\n"
                             "    recursion.begin(R);\n"
                             "    for (int l = 1; l < {0}; ++l) {{\n"
                             "        if (l > 1) recursion.next();\n"
                             "        recursion.rotate(f + l * l, out + l * l);\n"
                             "    }}\n",
                             order),
                 count_of_products(order), order);
}

}  // namespace zonal::kernels
