#include "bounds/chosen_rotate.hpp"

namespace zonal {

kernels::RotateChoice chosen_rotate(const OrderKernels& order, const std::map<std::string, Bound>& published,
                                    kernels::Processor processor) {
    std::map<std::string, kernels::ErrorBounds> bounds;
    for (const auto& [kernel, bound] : published) {
        if (processor == kernels::Processor::gpu)
            bounds[kernel] = {std::stod(bound.float_apart), 0};
        else
            bounds[kernel] = {std::stod(bound.float_text), std::stod(bound.double_text)};
    }
    return kernels::choose_rotate(order.order, order.kernels, bounds, processor);
}

}  // namespace zonal
