#pragma once

#include <string>

#include "lobes/lobe_table.hpp"
#include "lobes/table_complaints.hpp"

namespace zonal {

/// The table as its file claims it, unverified and not factorized. `use` says which order or band is wanted;
/// the table's own role is what the file says.
LobeTable table_of_json(const std::string& text, const LobeUse& use, const TableComplaints& complaints);

/// A lobe a line, so that a changed lobe is a changed line.
std::string json_of_table(const LobeTable& table);

}  // namespace zonal
