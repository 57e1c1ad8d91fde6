#pragma once

#include "lobes/lobe_table.hpp"
#include "lobes/table_complaints.hpp"

namespace zonal {

/// Believes a table only as far as its directions confirm it: zeros, nonzeros and conditions are computed
/// afresh at 50 digits and compared with what the file claims. Leaves the factorizations in the table.
/// Precondition: as many lobes, zeros and conditions as its use has.
void check_table(LobeTable& table, double condition_cap, const TableComplaints& complaints);

}  // namespace zonal
