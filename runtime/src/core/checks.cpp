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

namespace {

std::size_t coefficients_of(int order) {
    return static_cast<std::size_t>(order) * static_cast<std::size_t>(order);
}

[[noreturn]] void throw_length(const char* field, int order, std::size_t length, std::string next_step) {
    throw Error({.field = joined("length of ", field, " for order ", order),
                 .found = text_of(length),
                 .wanted = text_of(coefficients_of(order)),
                 .next_step = std::move(next_step)});
}

}  // namespace

void check_length(const char* field, int order, std::size_t length) {
    if (length == coefficients_of(order)) return;
    throw_length(field, order, length,
                 "pass one value per coefficient, or the order that belongs to the data");
}

void check_rotated_length(const char* field, int order, std::size_t length) {
    if (length == coefficients_of(order)) return;
    const bool is_several = length > 0 && length % coefficients_of(order) == 0;
    throw_length(field, order, length,
                 is_several ? "pass zonal::Rgb for three channels; of more channels or vectors "
                              "zonal/batch.hpp rotates all"
                            : "pass one value per coefficient, or the order that belongs to the data");
}

void throw_partial_overlap() {
    throw Error({.field = "in and out",
                 .found = "spans that overlap in part",
                 .wanted = "the same span, or separate ones",
                 .next_step = "write into a separate array"});
}

}  // namespace zonal
