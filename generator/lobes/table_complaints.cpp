#include "lobes/table_complaints.hpp"

#include <fmt/format.h>

#include "io/user_error.hpp"

namespace zonal {

void TableComplaints::missing() const {
    throw UserError(fmt::format("{}: no such table, or it cannot be read; wanted the lobes of {} {}; {}",
                                path_.string(), use_.field, use_.value, next_step()));
}

void TableComplaints::complain(const std::string& field, const std::string& found,
                               const std::string& wanted) const {
    throw UserError(
        fmt::format("{}: {}: found {}, wanted {}; {}", path_.string(), field, found, wanted, next_step()));
}

std::string TableComplaints::next_step() const {
    return fmt::format(
        "restore the file (its field command says how it was found), or seek other lobes under another name: "
        "zonal-gen search {} --out NEW.json",
        use_.options());
}

}  // namespace zonal
