// Rotation by sparse zonal-harmonic factorization: the kernels that need a lobe table.
//
// Band l of a signal is a sum of 2l+1 zonal lobes with weights ẑ = Âᵀ f, where Â is sparse by the choice of
// the lobe directions; turning the signal turns the lobes and keeps the weights. Source: Nowrouzezahrai,
// Simari, Fiume, "Sparse Zonal Harmonic Factorization for Efficient SH Rotation", eqs. 7 to 11.
#include "kernels/lobes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>
#include <set>

#include "exact/legendre.hpp"
#include "exact/spherical_harmonics.hpp"
#include "graph/passes.hpp"
#include "graph/shared_sums.hpp"
#include "graph/sizes.hpp"
#include "graph/sum.hpp"
#include "kernels/lobe_tensor.hpp"
#include "kernels/rotation_scalars.hpp"
#include "lobes/ring.hpp"

namespace zonal::kernels {

namespace {

using exact::Real;
using graph::Kernel;
using graph::Kind;
using graph::Value;

const char* const kPaper = "Nowrouzezahrai, Simari, Fiume 2012, ";

int band_start(int l) { return l * l; }
int band_size(int l) { return 2 * l + 1; }

/// Some values of an array, one after another.
struct Range {
    int array = 0, first = 0, count = 0;
};

Range signal_range(int array, int l) { return {array, band_start(l), band_size(l)}; }

Range weight_range(const LobeSet& lobes, int array, int l) {
    return {array, lobes.weight_start(l), static_cast<int>(lobes.lobes_of[l].size())};
}

std::string weight_layout(const LobeSet& lobes) {
    if (lobes.is_ring) {
        const std::size_t count = lobes.lobes_of[0].size();
        return fmt::format("band l at {0}*l, lobe d at {0}*l + d, d = 0 .. {1} around the ring", count,
                           count - 1);
    }
    return "band l at l*l, lobe d at l*l + d, d = 0 .. 2l in table order";
}

graph::Array signal_array(const LobeSet& lobes, const char* name) {
    return {name, Kind::signal, lobes.order * lobes.order, "index l(l+1)+m"};
}

graph::Array weight_array(const LobeSet& lobes, const char* name) {
    return {name, Kind::signal, lobes.weight_start(lobes.order), weight_layout(lobes)};
}

/// The sums over k of matrix(i, k) * in_k, and what they share.
graph::SharedSums shared_sums(Kernel& kernel, const exact::Matrix<Real>& matrix, const Range& in) {
    std::vector<std::vector<Real>> factors;
    std::vector<Value> inputs;
    for (int k = 0; k < in.count; ++k) inputs.push_back(kernel.input(in.array, in.first + k));
    for (const auto& row : matrix.rowwise()) factors.emplace_back(row.begin(), row.end());
    return {kernel.graph, factors, std::move(inputs)};
}

/// Stores matrix * in, a band's. Where signal and weights of a band lie at different places, all bands are
/// stored at the end, so that the kernel may write over its input.
void build_band_product(Kernel& kernel, const LobeSet& lobes, int l, const exact::Matrix<Real>& matrix,
                        const Range& in, int out, const char* result_name) {
    graph::SharedSums sums = shared_sums(kernel, matrix, in);
    for (int i = 0; i < matrix.rows(); ++i) {
        kernel.graph.set_scope(fmt::format("b{}_{}{}", l, result_name, i));
        kernel.store(out + i, sums.output(i), lobes.is_ring ? 0 : l);
    }
}

/// Y_l of a band's lobes, exact zeros where it vanishes.
exact::Matrix<Real> expansion(const LobeSet& lobes, int l) {
    std::vector<exact::Direction<Real>> directions;
    for (const int d : lobes.lobes_of[l]) directions.push_back(lobes.directions[d]);
    exact::Matrix<Real> y = exact::band_matrix<Real>(l, directions);
    exact::set_small_to_zero(y);
    return y;
}

Vector3 rotate_direction(Kernel& kernel, const Matrix3& rows, const exact::Direction<Real>& direction,
                         int lobe) {
    Vector3 turned;
    for (int i = 0; i < 3; ++i) {
        std::vector<graph::Term> terms;
        for (int j = 0; j < 3; ++j) {
            const Real component = abs(direction(j)) < exact::kZeroThreshold ? Real(0) : direction(j);
            terms.push_back({component, rows[i][j]});
        }
        turned[i] = linear_combination(kernel.graph, terms);
        kernel.graph.set_name(turned[i].id, fmt::format("{}_d{}", "xyz"[i], lobe));
    }
    return turned;
}

/// From this order on turned lobes are brought back to length 1. Of what rounding does to a direction its
/// length costs nearly all: harmonics are polynomials that are harmonic on the sphere only, and weights of
/// opposite signs amplify what they lose. The error of `rotate_zhf` in float so falls to half at orders 6
/// and 8, for 8 and 5 % more instructions; below, it is small anyway.
constexpr int kSmallestOrderOfUnitLobes = 6;

/// One Newton step: v + v (1 - v.v) / 2.
Vector3 with_unit_length(const Vector3& v) {
    const Value along_z = v[2] * v[2] + Real(-1);
    const Value along_yz = v[1] * v[1] + along_z;
    const Value excess = v[0] * v[0] + along_yz;
    const Value correction = Real(-0.5) * excess;
    Vector3 unit;
    for (int i = 0; i < 3; ++i) unit[i] = v[i] + correction * v[i];
    return unit;
}

/// The spherical harmonics of one turned lobe without their constant factors, made when first asked for:
/// y_l^m = basis_scale(l, m) * q_l^|m|(z) * {C_m, S_m}(x, y).
class LobeHarmonics {
  public:
    LobeHarmonics(Kernel& kernel, const Vector3& direction, int lobe)
        : kernel_(kernel), x_(direction[0]), y_(direction[1]), z_(direction[2]), lobe_(lobe) {
        powers_[1] = {x_, y_};
    }

    /// C_m + i S_m = (x + iy)^m, m >= 1.
    struct Power {
        Value cosine, sine;
    };
    Power power(int m) {
        const auto known = powers_.find(m);
        if (known != powers_.end()) return known->second;
        const Power p = m == 2 ? square() : next(power(m - 1));
        name(p.cosine, fmt::format("c{}", m));
        name(p.sine, fmt::format("s{}", m));
        return powers_[m] = p;
    }

    /// q_l^m(z), the monic multiple of d^m P_l / dz^m, by its three-term recurrence in l. The expanded
    /// polynomial would take fewer products from degree 4 on, and loses (1 + √2)^l in accuracy at the pole.
    Value legendre(int l, int m) {
        const auto known = legendre_.find({l, m});
        if (known != legendre_.end()) return known->second;
        const Real a = recurrence(l - 1, m);
        Value q;
        switch (l - m) {
            case 1:
                return z_;
            case 2:
                q = square_minus(a);
                break;
            case 3:
                q = z_ * square_minus(a + recurrence(l - 2, m));
                break;
            default: {
                const Value before = a * legendre(l - 2, m);
                const Value last = z_ * legendre(l - 1, m);
                q = last - before;
            }
        }
        name(q, fmt::format("q{}_{}", l, m));
        return legendre_[{l, m}] = q;
    }

  private:
    /// z² - c. The first one fuses; the others differ from it by a constant, an addition in place of a fused
    /// instruction.
    Value square_minus(const Real& c) {
        if (square_.graph == nullptr) {
            square_ = z_ * z_ + (-c);
            square_offset_ = c;
        }
        return square_ + (square_offset_ - c);
    }
    /// q_{l+1}^m = z q_l^m - recurrence(l, m) q_{l-1}^m
    static Real recurrence(int l, int m) { return Real(l * l - m * m) / (4 * l * l - 1); }
    // One product a line: the order in which C++ evaluates two operands is the compiler's choice, and the
    // order in which nodes are made shows in the emitted code.
    Power square() const {
        const Value y_y = y_ * y_;
        const Value x_x = x_ * x_;
        const Value cosine = x_x - y_y;
        return {cosine, (x_ + x_) * y_};
    }
    Power next(const Power& p) const {
        const Value y_sine = y_ * p.sine;
        const Value x_cosine = x_ * p.cosine;
        const Value cosine = x_cosine - y_sine;
        const Value y_cosine = y_ * p.cosine;
        const Value x_sine = x_ * p.sine;
        return {cosine, x_sine + y_cosine};
    }
    void name(Value value, const std::string& meaning) {
        kernel_.graph.set_name(value.id, fmt::format("{}_d{}", meaning, lobe_));
    }

    Kernel& kernel_;
    Value x_, y_, z_;
    int lobe_;
    Value square_;  ///< z² - square_offset_, once it was asked for
    Real square_offset_;
    std::map<int, Power> powers_;
    std::map<std::pair<int, int>, Value> legendre_;
};

/// A common factor taken out of a band's weights ẑ and put into the constants its outputs are multiplied by
/// anyway: the one that leaves the fewest factors other than ±1, those of equal size in a column counted
/// once.
Real cheapest_weight_scale(const BandFactorization& band) {
    const int l = band.band;
    graph::Sizes scales;
    std::vector<int> saved(1, 0);  // by scale: columns and outputs that it turns into ±1
    const auto count = [&](const std::set<int>& numbers) {
        saved.resize(scales.count(), 0);
        for (const int number : numbers) ++saved[number];
    };
    for (int m = -l; m <= l; ++m) count({scales.number_of(1 / exact::basis_scale(l, m))});
    for (int d = 0; d < band.a_hat.cols(); ++d) {
        std::set<int> numbers;
        for (const Real& entry : band.a_hat.col(d))
            if (entry != 0) numbers.insert(scales.number_of(entry));
        count(numbers);
    }
    // The first of equally cheap ones.
    const auto best = std::max_element(saved.begin(), saved.end());
    return scales[static_cast<int>(best - saved.begin())];
}

/// Band 1 is a vector in space (y, z, x): the paper turns it directly ("optimal linear lobe").
void turn_band_1(Kernel& kernel, const Matrix3& rows) {
    const std::array<int, 3> axis_of{1, 2, 0};  // of coefficients 1, 2, 3
    kernel.graph.set_scope("b1");
    for (int i = 0; i < 3; ++i) {
        Value sum{&kernel.graph, kernel.graph.constant(0)};
        for (int j = 0; j < 3; ++j) sum = sum + rows[axis_of[i]][axis_of[j]] * kernel.input(1, 1 + j);
        kernel.store(1 + i, sum, 1);
    }
}

/// f'_lm = scale_lm * sum_d ẑ_d q_l^m(z_d) {C_m, S_m}(x_d, y_d), lobe by lobe.
void build_band(Kernel& kernel, const LobeSet& lobes, int l, std::vector<LobeHarmonics>& harmonics) {
    const BandFactorization& band = lobes.bands[l];
    const int count = static_cast<int>(lobes.lobes_of[l].size());
    const Real weight_scale = cheapest_weight_scale(band);
    const exact::Matrix<Real> scaled = band.a_hat.transpose() / weight_scale;
    graph::SharedSums shared = shared_sums(kernel, scaled, signal_range(1, l));
    std::vector<Value> weights, sums(band_size(l), Value{&kernel.graph, kernel.graph.constant(0)});
    for (int d = 0; d < count; ++d) {
        kernel.graph.set_scope(fmt::format("b{}_d{}", l, d));
        weights.push_back(shared.output(d));
        kernel.graph.set_name(weights.back().id, fmt::format("b{}_d{}", l, d));
    }
    for (int d = 0; d < count; ++d) {
        kernel.graph.set_scope(fmt::format("b{}_d{}", l, d));
        LobeHarmonics& lobe = harmonics[lobes.lobes_of[l][d]];
        sums[l] = sums[l] + lobe.legendre(l, 0) * weights[d];
        for (int m = 1; m <= l; ++m) {
            const auto [cosine, sine] = lobe.power(m);
            const Value weighted = m == l ? weights[d] : lobe.legendre(l, m) * weights[d];
            sums[l + m] = sums[l + m] + cosine * weighted;
            sums[l - m] = sums[l - m] + sine * weighted;
        }
    }
    kernel.graph.set_scope(fmt::format("b{}", l));
    for (int m = -l; m <= l; ++m)
        kernel.store(band_start(l) + l + m, (exact::basis_scale(l, m) * weight_scale) * sums[l + m], l);
}

}  // namespace

LobeSet LobeSet::shared(const LobeTable& table) {
    LobeSet set{table.use.value, false, directions_of(table.lobes), {}, table.bands};
    for (const int l : table.use.bands) {
        set.lobes_of.emplace_back(band_size(l));
        std::iota(set.lobes_of[l].begin(), set.lobes_of[l].end(), 0);
    }
    return set;
}

LobeSet LobeSet::ring(int order) {
    const Ring ring = best_ring(order);
    LobeSet set{order, true, ring.directions(), {}, {}};
    std::vector<int> all(ring.count);
    std::iota(all.begin(), all.end(), 0);
    for (int l = 0; l < order; ++l) {
        set.lobes_of.push_back(all);
        set.bands.push_back(ring.factorize(l));
    }
    return set;
}

LobeSet LobeSet::per_band(const std::vector<const LobeTable*>& tables) {
    using Direction = exact::Direction<Real>;
    LobeSet set;
    const auto append = [&](const BandFactorization& band, const std::vector<Direction>& lobes) {
        set.lobes_of.emplace_back(lobes.size());
        std::iota(set.lobes_of.back().begin(), set.lobes_of.back().end(),
                  static_cast<int>(set.directions.size()));
        set.directions.insert(set.directions.end(), lobes.begin(), lobes.end());
        set.bands.push_back(band);
        ++set.order;
    };
    const std::vector<Direction> pole{Direction::UnitZ()};
    const std::vector<Direction> axes{Direction::UnitY(), Direction::UnitZ(), Direction::UnitX()};
    append(factorize_band(0, pole), pole);
    append(factorize_band(1, axes), axes);
    for (const LobeTable* table : tables) append(table->bands.front(), directions_of(table->lobes));
    return set;
}

int LobeSet::weight_start(int l) const {
    int start = 0;
    for (int band = 0; band < l; ++band) start += static_cast<int>(lobes_of[band].size());
    return start;
}

graph::Counts factorization_counts(const BandFactorization& band) {
    Kernel kernel;
    kernel.inputs = {{"f", Kind::signal, band_size(band.band), ""}};
    graph::SharedSums sums = shared_sums(kernel, band.a_hat.transpose(), {0, 0, band_size(band.band)});
    for (int d = 0; d < band_size(band.band); ++d) kernel.store(d, sums.output(d), 0);
    return graph::count_operations(graph::optimize(std::move(kernel))).total();
}

Kernel build_factorize(const LobeSet& lobes) {
    Kernel kernel;
    kernel.name = "factorize";
    kernel.summary = "Weights of the lobes whose sum is the signal: z = A^T f with A = Y^-1, band by band.";
    kernel.sources = {std::string(kPaper) + "eq. 7 and the one after it"};
    kernel.inputs = {signal_array(lobes, "f")};
    kernel.output = weight_array(lobes, "z");
    for (int l = 0; l < lobes.order; ++l)
        build_band_product(kernel, lobes, l, lobes.bands[l].a_hat.transpose(), signal_range(0, l),
                           lobes.weight_start(l), "d");
    return kernel;
}

Kernel build_expand(const LobeSet& lobes) {
    Kernel kernel;
    kernel.name = "expand";
    kernel.summary = "The signal that weighted lobes sum to: f = Y^T z, band by band; undoes factorize.";
    kernel.sources = {std::string(kPaper) + "section 4"};
    kernel.inputs = {weight_array(lobes, "z")};
    kernel.output = signal_array(lobes, "f");
    for (int l = 0; l < lobes.order; ++l)
        build_band_product(kernel, lobes, l, expansion(lobes, l).transpose(), weight_range(lobes, 0, l),
                           band_start(l), "m");
    return kernel;
}

Kernel build_resample(const LobeSet& lobes) {
    Kernel kernel;
    kernel.name = "resample";
    kernel.summary =
        "The rotated signal from samples of its bands: the element of band l and lobe d is band l of the\n"
        "unrotated signal, f_l(w) = sum_m f_lm y_lm(w), at w = R^T (direction of lobe d).";
    kernel.sources = {std::string(kPaper) + "eq. 11"};
    kernel.inputs = {weight_array(lobes, "samples")};
    kernel.output = signal_array(lobes, "out");
    for (int l = 0; l < lobes.order; ++l)
        build_band_product(kernel, lobes, l, lobes.bands[l].a_hat, weight_range(lobes, 0, l), band_start(l),
                           "m");
    return kernel;
}

Kernel build_lobes(const LobeSet& lobes) {
    Kernel kernel;
    kernel.name = "lobes";
    kernel.summary = "Rotates the lobe directions of the table: R times each.";
    kernel.sources = {std::string(kPaper) + "eq. 9"};
    kernel.inputs = {rotation_array()};
    const int count = static_cast<int>(lobes.directions.size());
    kernel.output = {"directions", Kind::rotation, 3 * count, "unit vectors x, y, z, in table order"};
    const auto rows = rotation_rows(kernel);
    for (int d = 0; d < count; ++d) {
        kernel.graph.set_scope(fmt::format("d{}", d));
        const Vector3 turned = rotate_direction(kernel, rows, lobes.directions[d], d);
        for (int i = 0; i < 3; ++i) kernel.store(3 * d + i, turned[i], d);
    }
    return kernel;
}

Kernel build_rotate_zhf(const LobeSet& lobes) {
    Kernel kernel;
    kernel.name = "rotate_zhf";
    kernel.summary =
        "Rotates a signal by its lobes: f'(w) = f(R^T w). Rotates the function, not the frame.\n"
        "Bands are independent: a NaN stays in its band.";
    kernel.sources = {std::string(kPaper) + "eq. 10"};
    kernel.has_bound = true;
    kernel.inputs = {rotation_array(), signal_array(lobes, "f")};
    kernel.output = signal_array(lobes, "out");
    const Matrix3 given = rotation_rows(kernel);
    kernel.store(0, kernel.input(1, 0), 0);
    if (lobes.order == 3 && !lobes.is_ring) {
        // One band to turn: six lobes as a tensor cost less than an orthonormal matrix.
        turn_band_1(kernel, given);
        build_band_2_tensor(kernel, given, lobes);
        return kernel;
    }
    const Matrix3 rows = orthonormalized(kernel, given);
    turn_band_1(kernel, rows);
    std::vector<LobeHarmonics> harmonics;
    for (int d = 0; d < static_cast<int>(lobes.directions.size()); ++d) {
        kernel.graph.set_scope(fmt::format("d{}", d));
        Vector3 turned = rotate_direction(kernel, rows, lobes.directions[d], d);
        if (lobes.order >= kSmallestOrderOfUnitLobes) turned = with_unit_length(turned);
        harmonics.emplace_back(kernel, turned, d);
    }
    for (int l = 2; l < lobes.order; ++l) build_band(kernel, lobes, l, harmonics);
    return kernel;
}

}  // namespace zonal::kernels
