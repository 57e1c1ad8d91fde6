#pragma once

#include <map>
#include <string>

#include "bounds/bound.hpp"
#include "kernels/order_kernels.hpp"
#include "kernels/rotate_choice.hpp"

namespace zonal {

/// What `rotate` of an order is on a processor, by the bounds that `published_bounds` gives.
kernels::RotateChoice chosen_rotate(const OrderKernels& order, const std::map<std::string, Bound>& published,
                                    kernels::Processor processor);

}  // namespace zonal
