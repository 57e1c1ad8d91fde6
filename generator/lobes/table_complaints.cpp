#include "lobes/table_complaints.hpp"

#include <fmt/format.h>

#include "io/user_error.hpp"

namespace zonal {

void TableComplaints::unreadable(const std::string& reason) const {
    throw UserError(
        fmt::format("{}: file: found nothing that can be read ({}), wanted the lobes of {} {}; {}",
                    path_.string(), reason, use_.field, use_.value, other_table()));
}

void TableComplaints::of_another_use(const std::string& field, const std::string& found,
                                     const std::string& wanted) const {
    throw UserError(
        fmt::format("{}: {}: found {}, wanted {}; {}", path_.string(), field, found, wanted, other_table()));
}

void TableComplaints::complain(const std::string& field, const std::string& found,
                               const std::string& wanted) const {
    throw UserError(fmt::format(
        "{}: {}: found {}, wanted {}; restore the file (its field command says how it was found), or {}",
        path_.string(), field, found, wanted, other_table()));
}

std::string TableComplaints::other_table() const {
    return fmt::format("name another table, such as one by: zonal-gen search {} --out NEW.json",
                       use_.options());
}

}  // namespace zonal
