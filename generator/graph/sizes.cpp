#include "graph/sizes.hpp"

namespace zonal::graph {

namespace {

/// Factors that agree to this relative difference are one constant; they carry 50 digits less the condition.
const Number kSameConstant{"1e-35"};

}  // namespace

Sizes::Sizes() : sizes_{Number(1)}, numbers_{{Number(1), kUnit}} {}

int Sizes::number_of(const Number& factor) {
    const Number size = abs(factor);
    const auto near = numbers_.lower_bound(size * (1 - kSameConstant));
    if (near != numbers_.end() && near->first <= size * (1 + kSameConstant)) return near->second;
    numbers_.emplace(size, count());
    sizes_.push_back(size);
    return count() - 1;
}

int Sizes::quotient(int a, int b) {
    if (a == b) return kUnit;
    if (b == kUnit) return a;
    const auto [known, is_new] = quotients_.try_emplace({a, b}, 0);
    if (is_new) known->second = number_of(sizes_[a] / sizes_[b]);
    return known->second;
}

}  // namespace zonal::graph
