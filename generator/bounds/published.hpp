#pragma once

#include <map>
#include <string>

#include "emit/unit.hpp"
#include "lobes/order_tables.hpp"

namespace zonal {

/// The project's published error bounds by kernel (generator/tables/README.md says how they were measured):
/// of an order those of kernels that need no table, and of the very table that `rotate_zhf` is made of.
std::map<std::string, emit::Bound> published_bounds(int order, const OrderTables& tables);

}  // namespace zonal
