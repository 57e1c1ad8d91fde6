#include "bounds/chosen_rotate.hpp"

#include "bounds/published.hpp"

namespace zonal {

kernels::RotateChoice chosen_rotate(const OrderKernels& order, kernels::Processor processor) {
    std::map<std::string, kernels::ErrorBounds> bounds;
    for (const auto& [kernel, bound] : published_bounds(order.order, order.tables, order.kernels)) {
        const double in_float = std::stod(bound.float_text);
        bounds[kernel] = {in_float, processor == kernels::Processor::cpu ? std::stod(bound.double_text) : 0};
    }
    return kernels::choose_rotate(order.order, order.kernels, bounds, processor);
}

}  // namespace zonal
