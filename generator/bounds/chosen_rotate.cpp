#include "bounds/chosen_rotate.hpp"

#include "bounds/published.hpp"

namespace zonal {

kernels::RotateChoice chosen_rotate(const OrderKernels& order, kernels::Processor processor) {
    std::map<std::string, kernels::ErrorBounds> bounds;
    for (const auto& [kernel, bound] : published_bounds(order)) {
        if (processor == kernels::Processor::gpu)
            bounds[kernel] = {std::stod(bound.float_apart), 0};
        else
            bounds[kernel] = {std::stod(bound.float_text), std::stod(bound.double_text)};
    }
    return kernels::choose_rotate(order.order, order.kernels, bounds, processor);
}

}  // namespace zonal
