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

std::vector<CompiledOrder> orders_with_tensor() {
    std::vector<CompiledOrder> found;
    for (const CompiledOrder& compiled : all_orders()) {
        if (compiled.has_tensor() != is_to_have_tensor(compiled.order))
            throw std::logic_error("rotate_tensor of order " + std::to_string(compiled.order));
        if (compiled.has_tensor()) found.push_back(compiled);
    }
    return found;
}

std::vector<LobeVariant> lobes_of_all_orders(const std::vector<LobeVariant::Layout>& layouts) {
    std::vector<LobeVariant> found;
    for (const CompiledOrder& compiled : all_orders()) {
        if (!is_to_have_lobes(compiled.order)) continue;
        for (const LobeVariant::Layout layout : layouts) {
            const auto lobes = std::ranges::find(compiled.lobes, layout, &LobeVariant::layout);
            if (lobes == compiled.lobes.end())
                throw std::logic_error("lobes of order " + std::to_string(compiled.order));
            found.push_back(*lobes);
        }
    }
    return found;
}

bool add_compiled_order(CompiledOrder order) {
    std::vector<CompiledOrder>& all = all_orders();
    const auto place = std::ranges::find_if(
        all, [&](const CompiledOrder& compiled) { return compiled.order > order.order; });
    all.insert(place, std::move(order));
    return true;
}

}  // namespace zonal
