// Band 2 by lobes, as the symmetric traceless tensor S = sum_d ẑ_d (ω_d ω_dᵀ - I/3).
//
// A lobe's direction enters by its square only, so its length is free (the weight takes it back) and most
// turned lobes need additions alone. I is the sum of three lobes along the axes; with their weights S is a
// sum of squares that holds whatever R is, so that R S Rᵀ needs |R ω| = 1 nowhere: what R lacks in
// orthonormality is not amplified. Source: Nowrouzezahrai et al., eq. 10; the tensor form of band 2 is the
// addition theorem for l = 2.
#include "kernels/lobe_tensor.hpp"

#include <fmt/format.h>

#include "graph/sum.hpp"

namespace zonal::kernels {

namespace {

using exact::Direction;
using exact::Real;
using graph::Number;
using graph::Value;

constexpr int kFirst = 4, kCount = 5;  // the coefficients of band 2

/// weight * direction directionᵀ, the weight being linear in the band's coefficients.
struct Square {
    Direction<Real> direction;
    exact::Vector<Real> weight;
};

bool is_axis(const Direction<Real>& direction, int axis) {
    return abs(abs(direction(axis)) - 1) < exact::kZeroThreshold;
}

/// S as a sum of squares: the lobes, and -(sum_d ẑ_d)/3 along each axis, joined where a lobe is an axis.
std::vector<Square> squares_of(const LobeSet& lobes) {
    const exact::Matrix<Real>& a_hat = lobes.bands[2].a_hat;
    std::vector<Square> squares;
    for (int d = 0; d < kCount; ++d)
        squares.push_back({lobes.directions[lobes.lobes_of[2][d]], a_hat.col(d)});
    const exact::Vector<Real> trace_part = -a_hat.rowwise().sum() / 3;
    for (int axis = 0; axis < 3; ++axis) {
        const auto known = std::find_if(squares.begin(), squares.end(), [&](const Square& square) {
            return is_axis(square.direction, axis);
        });
        if (known != squares.end())
            known->weight += trace_part;
        else
            squares.push_back({Direction<Real>::Unit(axis), trace_part});
    }
    return squares;
}

/// Lengthens a direction until its largest component is 1: a lobe like (1, ±1, 1)/√3 then needs no product.
void make_largest_component_one(Square& square) {
    const Real largest = square.direction.cwiseAbs().maxCoeff();
    square.direction /= largest;
    square.weight *= largest * largest;
}

}  // namespace

void build_band_2_tensor(graph::Kernel& kernel, const Matrix3& rows, const LobeSet& lobes) {
    graph::Graph& graph = kernel.graph;
    // y_2^{-2} = scale * x y for unit vectors; the scale goes into the weights, so that three outputs need
    // none.
    const Real scale = sqrt(15 / (4 * exact::pi()));
    const auto snapped = [](const Real& value) {
        return abs(value) < exact::kZeroThreshold ? Real(0) : value;
    };

    Matrix3 tensor;  // upper triangle of R S Rᵀ
    for (Vector3& row : tensor) row.fill({&graph, graph.constant(0)});
    int number = 0;
    for (Square square : squares_of(lobes)) {
        make_largest_component_one(square);
        graph.set_scope(fmt::format("b2_d{}", number));
        std::vector<graph::Term> terms;
        for (int k = 0; k < kCount; ++k)
            terms.push_back({snapped(square.weight(k) * scale), kernel.input(1, kFirst + k)});
        const Value weight = linear_combination(graph, terms);
        graph.set_name(weight.id, fmt::format("b2_d{}", number));
        Vector3 turned, weighted;
        for (int i = 0; i < 3; ++i) {
            std::vector<graph::Term> components;
            for (int j = 0; j < 3; ++j) components.push_back({snapped(square.direction(j)), rows[i][j]});
            turned[i] = linear_combination(graph, components);
            graph.set_name(turned[i].id, fmt::format("{}_d{}", "xyz"[i], number));
            weighted[i] = turned[i] * weight;
        }
        for (int i = 0; i < 3; ++i)
            for (int j = i; j < 3; ++j) tensor[i][j] = tensor[i][j] + turned[j] * weighted[i];
        ++number;
    }

    graph.set_scope("b2");
    const Value round = tensor[0][0] + tensor[1][1];
    const Real inverse_root_3 = 1 / sqrt(Real(3));
    kernel.store(kFirst + 0, tensor[0][1], 2);
    kernel.store(kFirst + 1, tensor[1][2], 2);
    kernel.store(kFirst + 2, inverse_root_3 * (tensor[2][2] - Number(0.5) * round), 2);
    kernel.store(kFirst + 3, tensor[0][2], 2);
    kernel.store(kFirst + 4, Number(0.5) * (tensor[0][0] - tensor[1][1]), 2);
}

}  // namespace zonal::kernels
