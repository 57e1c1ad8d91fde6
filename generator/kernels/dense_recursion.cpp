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

const char* const kLoops = R"(template <class T>
using constant_of = std::conditional_t<is_single<T>::value, float, double>;

// Band 1 by orders -1, 0, 1, that is y, z, x: entry (i, j) of a block at r[3 (i + 1) + j + 1].
// A row of band l is the sum of five rows of band l - 1 times these: row index and factor.
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
    const C v = RecursionRoots<C>::consecutive(l + k) / 2, w = RecursionRoots<C>::consecutive(l - k) / -2;
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

// Row m of band l in its columns |n| <= most; `before`: band l - 1.
template <class T>
ZONAL_INLINE void inner_row(int l, int m, int most, const T* r, const T* before, T* row) {
    using C = constant_of<T>;
    RowOfBandBefore<C> terms[5];
    rows_before(l, m, terms);
    const int width = 2 * l - 1;
    const T a = T(terms[0].factor) * r[3 * (terms[0].i + 1) + 1];
    const T b = T(terms[1].factor) * r[3 * (terms[1].i + 1) + 1];
    const T c = T(terms[2].factor) * r[3 * (terms[2].i + 1) + 1];
    const T d = T(terms[3].factor) * r[3 * (terms[3].i + 1) + 1];
    const T e = T(terms[4].factor) * r[3 * (terms[4].i + 1) + 1];
    const T* const row_a = before + (terms[0].row + l - 1) * width + l - 1;
    const T* const row_b = before + (terms[1].row + l - 1) * width + l - 1;
    const T* const row_c = before + (terms[2].row + l - 1) * width + l - 1;
    const T* const row_d = before + (terms[3].row + l - 1) * width + l - 1;
    const T* const row_e = before + (terms[4].row + l - 1) * width + l - 1;
    for (int n = -most; n <= most; ++n) {
        const T sum =
            fma(a, row_a[n], fma(b, row_b[n], fma(c, row_c[n], fma(d, row_d[n], e * row_e[n]))));
        row[n] = T(RecursionRoots<C>::over_product(l, n < 0 ? -n : n)) * sum;
    }
}

// Row m of band l in its columns n > 0 and -n, by y_1^1 y_{l-1}^{n-1} -+ y_1^{-1} y_{l-1}^{1-n}.
template <class T>
ZONAL_INLINE void outer_pair(int l, int m, int n, const T* r, const T* before, T* row) {
    using C = constant_of<T>;
    RowOfBandBefore<C> terms[5];
    rows_before(l, m, terms);
    const auto sum = [&](int j, int column) {
        const auto part = [&](int k) {
            return T(terms[k].factor) * r[3 * (terms[k].i + 1) + j + 1];
        };
        const auto entry = [&](int k) {
            return before[(terms[k].row + l - 1) * (2 * l - 1) + column + l - 1];
        };
        return fma(part(0), entry(0),
                   fma(part(1), entry(1),
                       fma(part(2), entry(2), fma(part(3), entry(3), part(4) * entry(4)))));
    };
    const T q = T(RecursionRoots<C>::over_consecutive(l + n));
    row[n] = q * (sum(1, n - 1) - sum(-1, 1 - n));
    row[-n] = q * (sum(1, 1 - n) + sum(-1, n - 1));
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
        const int width = 2 * l + 1, most = MOST_INNER;
        T* const now = blocks[l % 2];
        T* const now_by_columns = transposes[l % 2];
        const auto row_of = [&](T* matrix, int m) { return matrix + (m + l) * width + l; };
        for (int m = -l; m <= l; ++m) inner_row(l, m, most, r, before, row_of(now, m));
        // The matrix of the inverse: row m of it is column m.
        for (int k = most + 1; k <= l; ++k)
            for (const int m : {-k, k}) {
                inner_row(l, m, most, inverse, before_by_columns, row_of(now_by_columns, m));
                for (int n = most + 1; n < k; ++n)
                    outer_pair(l, m, n, inverse, before_by_columns, row_of(now_by_columns, m));
            }
        for (int k = most + 1; k <= l; ++k)
            for (const int m : {-k, k})
                for (int n = most + 1; n <= k; ++n) outer_pair(l, m, n, r, before, row_of(now, m));
        // What each has, the other takes.
        for (int m = -l; m <= l; ++m)
            for (int n = -l; n <= l; ++n) {
                const int row = m < 0 ? -m : m, column = n < 0 ? -n : n;
                T& direct = row_of(now, m)[n];
                T& mirrored = row_of(now_by_columns, n)[m];
                if (column > most && row < column)
                    direct = mirrored;
                else
                    mirrored = direct;
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
            fmt::format("{}C({:.17g}),", k % 4 == 0 ? "\n            " : " ", static_cast<double>(value(k)));
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
    constexpr int kPairs = 2 * kLastRecursionBand + 1, kProducts = (kLastRecursionBand + 1) * (kLastRecursionBand + 2) / 2;
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
        const int rows = 2 * l + 1 + 2 * outer, columns = 2 * most + 1, pairs = 2 * outer * outer;
        counts.mul += rows * (5 + 2 * columns) + pairs * (4 * 6 + 2);
        counts.fma += rows * 4 * columns + pairs * 4 * 4;
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
