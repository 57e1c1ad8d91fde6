#include "support/compiled_kernels.hpp"

#include <algorithm>
#include <stdexcept>

namespace zonal {

namespace {

std::vector<CompiledOrder>& all_orders() {
    static std::vector<CompiledOrder> all;
    return all;
}

}  // namespace

const std::vector<CompiledOrder>& compiled_orders() { return all_orders(); }

const CompiledOrder& compiled_order(int order) {
    for (const CompiledOrder& compiled : all_orders())
        if (compiled.order == order) return compiled;
    throw std::out_of_range("order " + std::to_string(order) + " is not compiled");
}

bool add_compiled_order(CompiledOrder order) {
    std::vector<CompiledOrder>& all = all_orders();
    const auto place = std::ranges::find_if(
        all, [&](const CompiledOrder& compiled) { return compiled.order > order.order; });
    all.insert(place, std::move(order));
    return true;
}

}  // namespace zonal
