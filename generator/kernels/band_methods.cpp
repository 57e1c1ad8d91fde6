#include "kernels/band_methods.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "kernels/contraction.hpp"
#include "kernels/dense_blocks.hpp"

namespace zonal::kernels {

namespace {

using graph::Kind;
using graph::Value;

constexpr int kLargestBand = 19;
/// Dense bands above this one need more instructions a vector than any form of zxzxz.
constexpr int kLargestDenseBand = 3;

const char* const kTensors = "low bands as tensors, contracted with the rows of R";

void build_dense_band(RotationBuilder& builder, int l) {
    const std::vector<Value>& block = builder.block(l);
    graph::Graph& graph = builder.kernel.graph;
    graph.set_scope(fmt::format("b{}", l));
    const int size = 2 * l + 1;
    for (int i = 0; i < size; ++i) {
        Value sum{&graph, graph.constant(0)};
        for (int j = 0; j < size; ++j) sum = sum + block[i * size + j] * builder.kernel.input(1, l * l + j);
        builder.kernel.store(l * l + i, sum, l);
    }
}

BandMethod contraction(const std::string& name, Reading reading) {
    BandMethod method{.name = name, .family = name, .source = kTensors, .last_band = kLargestContractionBand};
    method.build = [reading](RotationBuilder& builder, int l) {
        build_contraction_band(builder.kernel, builder.rows, l, reading);
    };
    return method;
}

const char* name_of(PartForm form) {
    switch (form) {
        case PartForm::transform:
            return "transform";
        case PartForm::update:
            return "update";
        case PartForm::scaled:
            return "scaled";
        case PartForm::sheared:
            return "sheared";
        case PartForm::reflect:
            return "reflect";
    }
    return "";
}

BandMethod zxzxz(const BandForms& forms) {
    BandMethod method{
        .name = fmt::format("zxzxz, even m {}, odd m {}", name_of(forms.even), name_of(forms.odd)),
        .family = "zxzxz",
        .source = "Pinchon and Hoggan 2007, section 4: Z(a) X Z(b) X^T Z(g), here without angles",
        .takes_mirrors = false,
        .first_band = 2,
        .last_band = kLargestBand,
        .is_chain = forms.even == PartForm::sheared || forms.odd == PartForm::sheared};
    method.build = [forms](RotationBuilder& builder, int l) {
        build_zxzxz_band(builder.kernel, builder.euler(), l, forms);
    };
    return method;
}

std::vector<BandMethod> make_methods() {
    std::vector<BandMethod> all{contraction("contraction", Reading::by_trace),
                                contraction("contraction, read directly", Reading::direct)};
    all[1].first_band = 2;  // a vector is read in one way
    all.push_back({.name = "contraction for det R = +1",
                   .family = "contraction for det R = +1",
                   .source = kTensors,
                   .takes_mirrors = false,
                   .first_band = 2,
                   .last_band = 2,
                   .build = [](RotationBuilder& builder, int) {
                       build_proper_contraction_band_2(builder.kernel, builder.rows);
                   }});
    all.push_back({.name = "dense",
                   .family = "dense",
                   .source = "Ivanic and Ruedenberg 1996, eqs. 6.3, 7.1, 8.1, with the erratum of 1998",
                   .first_band = 2,
                   .last_band = kLargestDenseBand,
                   .scalars = "d",
                   .build = build_dense_band});
    for (const BandForms& forms : band_forms()) all.push_back(zxzxz(forms));
    return all;
}

}  // namespace

RotationBuilder::RotationBuilder(int bands) : order(bands) {
    kernel.inputs = {rotation_array(), {"f", Kind::signal, order * order, "index l(l+1)+m"}};
    kernel.output = {"out", Kind::signal, order * order, "index l(l+1)+m"};
    rows = rotation_rows(kernel);
}

EulerScalars& RotationBuilder::euler() {
    if (!euler_) euler_.emplace(euler_scalars(kernel, rows, order));
    return *euler_;
}

const std::vector<Value>& RotationBuilder::block(int l) {
    if (static_cast<int>(blocks_.size()) <= l) blocks_ = dense_blocks(kernel, rows, l + 1);
    return blocks_[l];
}

const std::vector<BandMethod>& band_methods() {
    static const std::vector<BandMethod> all = make_methods();
    return all;
}

const BandMethod& band_method(const std::string& name) {
    const auto found = std::ranges::find(band_methods(), name, &BandMethod::name);
    if (found == band_methods().end()) throw std::logic_error("no band method " + name);
    return *found;
}

}  // namespace zonal::kernels
