// One band turned as Z(α) Y(β) Z(γ), Y(β) = X Z(β) Xᵀ, with neither an angle nor a pole.
//
// X, a quarter turn about the x axis, is constant and falls into four blocks: for each parity of m one whose
// y-polar orders are +m, one whose are -m. A z rotation mixes orders +m and -m only, so that a band is two
// parts, the even and the odd m, each of a block J (+m) and a block K (-m). The forms of a part differ in
// what they cost once per rotation and once per vector. Sources: Pinchon and Hoggan 2007 (rotation by a
// constant matrix and z rotations); the parameters without angles, the blocks and the forms are this
// project's: euler_scalars, exact/orthogonal_block and PartForm say how.
#include "kernels/zxzxz.hpp"

#include <fmt/format.h>

#include <map>
#include <mutex>
#include <optional>

#include "exact/orthogonal_block.hpp"
#include "exact/quarter_turn.hpp"
#include "graph/sum.hpp"

namespace zonal::kernels {

namespace {

using exact::BlockSteps;
using exact::QuarterTurnBlock;
using exact::Real;
using graph::Graph;
using graph::Number;
using graph::Value;

/// Up to this order set-up counts: the powers of the angles take the fewest instructions.
constexpr int kLastOrderOfRecurrence = 6;
/// At order 4, where γ has two powers to make, the least set-up counts more.
constexpr int kFirstOrderOfExactGamma = 5;

/// X with its columns multiplied by scales: u = Xᵀ p is `seen` times what the steps undone make of p, and the
/// steps make X u of u times `shown`.
struct ScaledSteps {
    BlockSteps steps;
    std::vector<Real> seen, shown;
};

/// A block of X with its cheapest factorization: as it is, by a product up to scales and by shears up to
/// scales.
struct Block {
    QuarterTurnBlock x;
    BlockSteps steps;
    ScaledSteps scaled, sheared;

    int size() const { return static_cast<int>(x.rows.size()); }
};

/// The matching of rows to columns whose entries have the largest product: by subsets of rows.
std::vector<int> best_matching(const exact::Matrix<Real>& matrix) {
    const int n = static_cast<int>(matrix.rows());
    std::vector<double> best(1 << n, -1.0);
    std::vector<int> last(1 << n, -1);
    best[0] = 1;
    for (int subset = 1; subset < (1 << n); ++subset) {
        const int column = __builtin_popcount(static_cast<unsigned>(subset)) - 1;
        for (int row = 0; row < n; ++row) {
            if (!((subset >> row) & 1)) continue;
            const double size =
                best[subset ^ (1 << row)] * std::abs(static_cast<double>(matrix(row, column)));
            if (size > best[subset] * (1 + 1e-9)) {
                best[subset] = size;
                last[subset] = row;
            }
        }
    }
    std::vector<int> row_of(n);
    for (int subset = (1 << n) - 1, column = n - 1; column >= 0; --column) {
        row_of[column] = last[subset];
        subset ^= 1 << last[subset];
    }
    return row_of;
}

ScaledSteps unscaled(const BlockSteps& steps) {
    return {steps, std::vector<Real>(steps.size, 1), std::vector<Real>(steps.size, 1)};
}

/// The product with a unit entry in every column (its transpose, which undoes it, has one in every row), if
/// that is cheaper than the steps.
ScaledSteps as_scaled_product(const exact::Matrix<Real>& x, const BlockSteps& steps) {
    const int n = steps.size;
    ScaledSteps scaled = unscaled(steps);
    if (n * (n - 1) >= exact::instructions(steps)) return scaled;
    const std::vector<int> matched_row = best_matching(x);
    exact::Matrix<Real> product = x;
    for (int j = 0; j < n; ++j) {
        scaled.seen[j] = abs(x(matched_row[j], j));
        product.col(j) /= scaled.seen[j];
    }
    scaled.shown = scaled.seen;
    scaled.steps = exact::as_product(product);
    return scaled;
}

ScaledSteps as_scaled_shears(const exact::Matrix<Real>& x) {
    const exact::ScaledBlocks sheared = exact::factorize_up_to_scales({x});
    ScaledSteps scaled{sheared.blocks[0], sheared.scales, sheared.scales};
    for (Real& scale : scaled.shown) scale = 1 / scale;
    return scaled;
}

/// J and K of one parity; K is empty for the even part of band 1.
struct Part {
    Block j, k;
    /// Steps up to scales that the turns of pairs (J, K) leave alone: of J and K where they are of one size,
    /// else of K.
    exact::ScaledBlocks shared;
};

struct Band {
    Part even, odd;
};

const Band& band_blocks(int l) {
    static std::map<int, Band> known;
    static std::mutex mutex;
    const std::lock_guard lock(mutex);
    const auto found = known.find(l);
    if (found != known.end()) return found->second;
    Band band;
    for (const QuarterTurnBlock& x : exact::quarter_turn_blocks(l)) {
        Part& part = x.columns.front() % 2 == 0 ? band.even : band.odd;
        Block& block = x.columns.back() < 0 ? part.k : part.j;
        const BlockSteps steps = exact::factorize_orthogonal(x.matrix);
        block = {x, steps, as_scaled_product(x.matrix, steps), as_scaled_shears(x.matrix)};
    }
    band.even.shared = exact::factorize_up_to_scales({band.even.k.x.matrix});
    band.odd.shared = exact::factorize_up_to_scales({band.odd.j.x.matrix, band.odd.k.x.matrix});
    return known.emplace(l, std::move(band)).first->second;
}

using Values = std::vector<Value>;

struct StepBuilder {
    Graph& graph;
    Values& x;
    bool is_undone;

    void operator()(const exact::Shear& shear) const {
        Value& target = x[shear.target];
        for (int j = 0; j < shear.factors.size(); ++j)
            if (shear.factors(j) != 0)
                target = target + (is_undone ? -shear.factors(j) : shear.factors(j)) * x[j];
    }
    void operator()(const exact::Reflection& reflection) const {  // its own inverse
        const auto rank = static_cast<int>(reflection.pivots.size());
        const auto n = static_cast<int>(x.size());
        Values seen;
        for (int k = 0; k < rank; ++k) {
            std::vector<graph::Term> terms;
            for (int i = 0; i < n; ++i) terms.push_back({reflection.forth(k, i), x[i]});
            seen.push_back(linear_combination(graph, terms));
        }
        for (int i = 0; i < n; ++i)
            for (int k = 0; k < rank; ++k) x[i] = x[i] - reflection.back(i, k) * seen[k];
    }
    void operator()(const exact::Product& product) const {
        const Values before = x;
        for (int i = 0; i < product.matrix.rows(); ++i) {
            std::vector<graph::Term> terms;
            for (int j = 0; j < product.matrix.cols(); ++j)
                terms.push_back({is_undone ? product.matrix(j, i) : product.matrix(i, j), before[j]});
            x[i] = linear_combination(graph, terms);
        }
    }
};

/// y = M x.
Values apply(Graph& graph, const BlockSteps& block, Values x) {
    for (const exact::BlockStep& step : block.steps) std::visit(StepBuilder{graph, x, false}, step);
    Values y;
    for (int i = 0; i < block.size; ++i) y.push_back(Number(block.signs[i]) * x[block.sources[i]]);
    return y;
}

/// The steps undone: x = M^-1 y, for a product Mᵀ y.
Values apply_inverse(Graph& graph, const BlockSteps& block, const Values& y) {
    Values x(block.size);
    for (int i = 0; i < block.size; ++i) x[block.sources[i]] = Number(block.signs[i]) * y[i];
    for (auto step = block.steps.rbegin(); step != block.steps.rend(); ++step)
        std::visit(StepBuilder{graph, x, true}, *step);
    return x;
}

/// (c u - s v, s u + c v).
void turn_pair(Value c, Value s, Value& u, Value& v) {
    const Value s_v = s * v;
    const Value turned_u = c * u - s_v;
    const Value c_v = c * v;
    v = s * u + c_v;
    u = turned_u;
}

/// Builds the bands' parts on the coefficients of one kernel.
class BandBuilder {
  public:
    BandBuilder(graph::Kernel& kernel, EulerScalars& scalars, int l)
        : kernel_(kernel), graph_(kernel.graph), scalars_(scalars), l_(l), band_(band_blocks(l)) {}

    void build(const BandForms& forms) {
        const int first = l_ * l_;
        for (int m = -l_; m <= l_; ++m) x_[m] = kernel_.input(1, first + l_ + m);
        turn_about_z(scalars_.gamma, "g");
        build_part(band_.even, forms.even, "e");
        build_part(band_.odd, forms.odd, "o");
        turn_about_z(scalars_.alpha, "a");
        for (int m = -l_; m <= l_; ++m) kernel_.store(first + l_ + m, x_[m], l_);
    }

  private:
    void set_scope(const char* stage) { graph_.set_scope(fmt::format("b{}_{}", l_, stage)); }

    void turn_about_z(AnglePowers& angle, const char* stage) {
        for (int m = 1; m <= l_; ++m) {
            const Value c = angle.cosine(m), s = angle.sine(m);
            set_scope(stage);
            turn_pair(c, s, x_[m], x_[-m]);
        }
    }

    Values gather(const std::vector<int>& orders) {
        Values values;
        for (const int m : orders) values.push_back(x_[m]);
        return values;
    }
    void scatter(const std::vector<int>& orders, const Values& values) {
        for (std::size_t i = 0; i < orders.size(); ++i) x_[orders[i]] = values[i];
    }

    void build_part(const Part& part, PartForm form, const char* stage) {
        stage_ = stage;
        switch (form) {
            case PartForm::transform:
                return transform(part);
            case PartForm::update:
                return update(part);
            case PartForm::scaled:
                return transform_scaled(part, part.j.scaled, part.k.scaled);
            case PartForm::sheared:
                return transform_scaled(part, part.j.sheared, part.k.sheared);
            case PartForm::reflect:
                return reflect(part);
        }
    }

    void transform(const Part& part) {
        set_scope(stage_);
        const int skipped = part.j.size() - part.k.size();  // m = 0 has no partner
        const BlockSteps& j_steps = skipped == 0 ? part.shared.blocks[0] : part.j.steps;
        const BlockSteps& k_steps = skipped == 0 ? part.shared.blocks[1] : part.k.steps;
        Values u = apply_inverse(graph_, j_steps, gather(part.j.x.rows));
        Values v = apply_inverse(graph_, k_steps, gather(part.k.x.rows));
        for (int i = 0; i < part.k.size(); ++i) {
            const int m = part.j.x.columns[i + skipped];
            Value& u_m = u[i + skipped];
            if (m % 2 == 1 || scalars_.has_even_power_of_beta(m)) {
                const Value c = scalars_.beta.cosine(m), s = scalars_.beta.sine(m);
                set_scope(stage_);
                turn_pair(c, s, u_m, v[i]);
            } else {
                // As a reflection at half the angle, which needs half as high a power: d = 2s u + 2c v.
                const int h = m / 2;
                const Value s2 = scalars_.beta.twice_sine(h), c2 = scalars_.beta.twice_cosine(h);
                const Value s = scalars_.beta.sine(h), c = scalars_.beta.cosine(h);
                set_scope(stage_);
                const Value c2_v = c2 * v[i];
                const Value d = s2 * u_m + c2_v;
                u_m = u_m - s * d;
                v[i] = c * d - v[i];
            }
        }
        scatter(part.j.x.rows, apply(graph_, j_steps, u));
        scatter(part.k.x.rows, apply(graph_, k_steps, v));
    }

    /// p stays in the z-polar basis: its component along column m of J is seen, and changed.
    void update(const Part& part) {
        const Values p = gather(part.j.x.rows);
        const BlockSteps& k_steps = part.shared.blocks[0];
        set_scope(stage_);
        Values q = apply_inverse(graph_, k_steps, gather(part.k.x.rows));
        Values turned = p;
        for (int k = 0; k < part.k.size(); ++k) {
            const int column = k + 1, h = part.j.x.columns[column] / 2;
            const Real& scale = part.shared.scales[k];
            const Value c2 = scalars_.beta.twice_cosine(h);
            const Value s = scalars_.beta.sine(h), c = scalars_.beta.cosine(h);
            set_scope(stage_);
            std::vector<graph::Term> terms;
            for (int i = 0; i < part.j.size(); ++i)
                terms.push_back({2 * part.j.x.matrix(i, column) / scale, p[i]});
            const Value twice_u = linear_combination(graph_, terms);
            const Value c2_q = c2 * q[k];
            const Value d = s * twice_u + c2_q;
            const Value change = s * d;
            for (int i = 0; i < part.j.size(); ++i)
                turned[i] = turned[i] - (part.j.x.matrix(i, column) * scale) * change;
            q[k] = c * d - q[k];
        }
        scatter(part.j.x.rows, turned);
        scatter(part.k.x.rows, apply(graph_, k_steps, q));
    }

    void transform_scaled(const Part& part, const ScaledSteps& j, const ScaledSteps& k) {
        const int skipped = part.j.size() - part.k.size();
        set_scope(stage_);
        Values u = apply_inverse(graph_, j.steps, gather(part.j.x.rows));
        Values v = apply_inverse(graph_, k.steps, gather(part.k.x.rows));
        const auto times = [](const Real& factor, Value value) {
            return abs(factor - 1) < exact::kZeroThreshold ? value : factor * value;
        };
        if (skipped == 1) u[0] = times(j.seen[0] * j.shown[0], u[0]);
        for (int i = 0; i < part.k.size(); ++i) {
            const int at = i + skipped, m = part.j.x.columns[at];
            const Value c = scalars_.beta.cosine(m), s = scalars_.beta.sine(m);
            graph_.set_scope(fmt::format("b{}_{}_scalar", l_, stage_));
            const Value c_j = times(j.seen[at] * j.shown[at], c);
            const Value s_jk = times(j.seen[at] * k.shown[i], s);
            const Value s_kj = times(k.seen[i] * j.shown[at], s);
            const Value c_k = times(k.seen[i] * k.shown[i], c);
            set_scope(stage_);
            const Value s_v = s_kj * v[i];
            const Value turned_u = c_j * u[at] - s_v;
            const Value c_v = c_k * v[i];
            v[i] = s_jk * u[at] + c_v;
            u[at] = turned_u;
        }
        scatter(part.j.x.rows, apply(graph_, j.steps, u));
        scatter(part.k.x.rows, apply(graph_, k.steps, v));
    }

    /// A plane rotation is a reflection after a change of sign; the signs of all K columns are those of its
    /// rows. So the part is p̃ - sum_h ω_h (ω_h·p̃), ω_h = √2 (X_im sin(hβ); -X_i,-m cos(hβ)), m = 2h, p̃ = (p,
    /// -q).
    void reflect(const Part& part) {
        const Real root_2 = sqrt(Real(2));
        std::vector<int> orders = part.j.x.rows;
        orders.insert(orders.end(), part.k.x.rows.begin(), part.k.x.rows.end());
        Values p = gather(orders);
        for (int i = part.j.size(); i < static_cast<int>(p.size()); ++i) p[i] = -p[i];
        Values turned = p;
        for (int k = 0; k < part.k.size(); ++k) {
            const int column = k + 1, h = part.j.x.columns[column] / 2;
            const Value c = scalars_.beta.cosine(h), s = scalars_.beta.sine(h);
            graph_.set_scope(fmt::format("b{}_{}_scalar", l_, stage_));
            Values omega;
            for (int i = 0; i < part.j.size(); ++i)
                omega.push_back((root_2 * part.j.x.matrix(i, column)) * s);
            for (int i = 0; i < part.k.size(); ++i) omega.push_back((-root_2 * part.k.x.matrix(i, k)) * c);
            set_scope(stage_);
            Value along{&graph_, graph_.constant(0)};
            for (std::size_t i = 0; i < p.size(); ++i) along = along + omega[i] * p[i];
            for (std::size_t i = 0; i < p.size(); ++i) turned[i] = turned[i] - omega[i] * along;
        }
        scatter(orders, turned);
    }

    graph::Kernel& kernel_;
    Graph& graph_;
    EulerScalars& scalars_;
    int l_;
    const Band& band_;
    const char* stage_ = "";
    std::map<int, Value> x_;  ///< the band's coefficients by order m
};

}  // namespace

EulerScalars euler_scalars(graph::Kernel& kernel, const Matrix3& rows, int order) {
    graph::Graph& graph = kernel.graph;
    graph.set_scope("euler");
    const auto named = [&](Value value, const char* name) {
        graph.set_name(value.id, name);
        return value;
    };
    // (-cos γ, sin γ) = (R20, R21) normalised; γ and not α, which the last of the three rotations needs:
    // chains are shorter, and one call faster by 2 to 12 %. (0, 0) gives (1, 0); the sum cannot cancel. A
    // square of R21 that is flushed to zero must be nothing beside that of the shift: in float it is up
    // to 1.2e-38, 1.2e-8 of it. The direction of (R20, R21) is wrong by the shift at most, which must be
    // nothing beside rounding.
    const Value x = named(rows[2][0] + copysign(Number("1e-18"), Number("1e-15"), rows[2][0]), "shifted_r20");
    const Value y = rows[2][1];
    const Value x_x = x * x;
    const Value squared_sin_b = named(y * y + x_x, "squared_sin_beta");
    Value sin_b = named(sqrt(squared_sin_b), "norm_r20_r21");
    // Two divisions, not products with one inverse: its rounding would be an error of the norm, which grows
    // in the powers.
    const Value minus_cos_g = x / sin_b;
    const Value cos_g = named(-minus_cos_g, "cos_gamma");
    const Value sin_g = named(y / sin_b, "sin_gamma");
    Value cos_b = rows[2][2];
    // A norm that is not 1, by noise in R or by rounding, would grow in the powers. The defects 1 - c² - s²
    // are rounded at their own size and not at that of 1. Powers make do with the defect; β, whose half
    // angles make reflections, takes a Newton step.
    const Value one{&graph, graph.constant(1)};
    const Value one_b = one - cos_b * cos_b;
    const Value half_defect_b = named(Number(0.5) * (one_b - squared_sin_b), "half_beta_defect");
    sin_b = named(half_defect_b * sin_b + sin_b, "sin_beta");
    cos_b = named(half_defect_b * cos_b + cos_b, "cos_beta");
    const auto defect_of = [&](Value cosine, Value sine, const char* name) {
        graph.set_scope("euler");
        const Value one_c = one - cosine * cosine;
        return named(one_c - sine * sine, name);
    };
    const bool has_exact_gamma = order >= kFirstOrderOfExactGamma;
    const Value defect_g = has_exact_gamma ? defect_of(cos_g, sin_g, "gamma_defect") : Value{};
    graph.set_scope("euler");
    // R Rz(-γ) = Rz(α) Ry(β), whose middle column is (-sin α, cos α, 0).
    const Value c0 = cos_g * rows[1][1];
    const Value cos_a = named(sin_g * rows[1][0] + c0, "cos_alpha");
    const Value c1 = cos_g * rows[0][1];
    const Value sin_a = named(-(sin_g * rows[0][0] + c1), "sin_alpha");
    const PowerChain chain = order <= kLastOrderOfRecurrence ? PowerChain::recurrence : PowerChain::product;
    EulerScalars scalars{order, AnglePowers(kernel, "alpha", cos_a, sin_a, chain, false),
                         AnglePowers(kernel, "beta", cos_b, sin_b, chain, true),
                         AnglePowers(kernel, "gamma", cos_g, sin_g, chain, false)};
    scalars.alpha.set_norm_defect(defect_of(cos_a, sin_a, "alpha_defect"));
    if (has_exact_gamma) scalars.gamma.set_norm_defect(defect_g);
    return scalars;
}

std::vector<BandForms> band_forms() {
    std::vector<BandForms> all;
    for (const PartForm even :
         {PartForm::transform, PartForm::update, PartForm::reflect, PartForm::scaled, PartForm::sheared})
        for (const PartForm odd : {PartForm::transform, PartForm::scaled, PartForm::sheared})
            all.push_back({even, odd});
    return all;
}

void build_zxzxz_band(graph::Kernel& kernel, EulerScalars& scalars, int l, const BandForms& forms) {
    BandBuilder(kernel, scalars, l).build(forms);
}

}  // namespace zonal::kernels
