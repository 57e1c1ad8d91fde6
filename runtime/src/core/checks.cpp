#include "checks.hpp"

#include "text.hpp"
#include "zonal/error.hpp"

namespace zonal {

void check_order(int order) {
    if (order >= 1 && order <= kMaxOrder) return;
    throw Error({.field = "order",
                 .found = text_of(order),
                 .wanted = joined("1 to ", kMaxOrder),
                 .next_step = "choose an order (number of bands) in this range"});
}

void check_length(const char* field, int order, std::size_t length) {
    const auto wanted = static_cast<std::size_t>(order) * static_cast<std::size_t>(order);
    if (length == wanted) return;
    throw Error({.field = joined("length of ", field, " for order ", order),
                 .found = text_of(length),
                 .wanted = text_of(wanted),
                 .next_step = "pass one value per coefficient, or the order that belongs to the data"});
}

void throw_partial_overlap() {
    throw Error({.field = "in and out",
                 .found = "spans that overlap in part",
                 .wanted = "the same span, or separate ones",
                 .next_step = "write into a separate array"});
}

}  // namespace zonal
