// Lobe tables as files: read with suspicion, written whole or not at all.
#include "lobes/lobe_table.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "io/input_file.hpp"
#include "io/output_file.hpp"
#include "io/sha256.hpp"
#include "io/user_error.hpp"
#include "lobes/table_check.hpp"
#include "lobes/table_json.hpp"

namespace zonal {
namespace {

std::string read_bytes(const std::filesystem::path& path, const TableComplaints& complaints) {
    try {
        return read_file(path);
    } catch (const Unreadable& error) {
        complaints.unreadable(error.what());
    }
}

LobeTable read(const std::filesystem::path& path, const LobeUse& use, bool is_for_any, double condition_cap) {
    const TableComplaints complaints(path, use);
    const std::string bytes = read_bytes(path, complaints);
    LobeTable table = table_of_json(bytes, use, complaints);
    table.sha256 = sha256_hex(bytes);
    if (!is_for_any && table.use.role != use.role)
        complaints.of_another_use("for", '"' + name_of(table.use.role) + '"', '"' + name_of(use.role) + '"');
    check_table(table, condition_cap, complaints);
    return table;
}

}  // namespace

void factorize(LobeTable& table) {
    table.zeros.clear();
    table.condition.clear();
    table.nonzeros = 0;
    table.bands.clear();
    const auto directions = directions_of(table.lobes);
    for (const int l : table.use.bands) {
        const BandFactorization& band = table.bands.emplace_back(factorize_band(l, directions));
        table.zeros.push_back(band.zeros);
        table.condition.push_back(band.condition);
        if (l >= 2) table.nonzeros += (2 * l + 1) * (2 * l + 1) - band.zeros;
    }
}

LobeTable read_lobe_table(const std::filesystem::path& path, const LobeUse& use, double condition_cap) {
    return read(path, use, false, condition_cap);
}

LobeTable read_lobe_table_of_any_role(const std::filesystem::path& path, const LobeUse& use) {
    return read(path, use, true, kConditionCap);
}

void write_lobe_table(const std::filesystem::path& path, const LobeTable& table) {
    write_file_atomically(path, json_of_table(table));
}

}  // namespace zonal
