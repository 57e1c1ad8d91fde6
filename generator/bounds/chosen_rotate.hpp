#pragma once

#include "kernels/order_kernels.hpp"
#include "kernels/rotate_choice.hpp"

namespace zonal {

/// What `rotate` of an order is on a processor, by the bounds that the project publishes. Throws `UserError`
/// as `published_bounds` does.
kernels::RotateChoice chosen_rotate(const OrderKernels& order, kernels::Processor processor);

}  // namespace zonal
