#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "exact/factorization.hpp"

namespace zonal {

/// Spherical angles of a lobe as text: a closed form in the small language of `generator/tables/README.md`
/// ("pi/2", "3*pi/8", "acos(sqrt(3/7))") where one is known, else decimals in radians.
struct LobeAngles {
    std::string theta;
    std::string phi;
};

/// Saved lobe directions of an order and how they were found. Schema: generator/tables/README.md.
struct LobeTable {
    int order = 0;
    std::uint64_t seed = 0;
    std::string command;
    std::vector<exact::Direction<exact::Real>> directions;  ///< 2*order-1, unit
    std::vector<LobeAngles> angles;                         ///< one per direction
    std::vector<int> zeros;                                 ///< per band 0 … order-1
    std::vector<double> condition;                          ///< cond_2(Y_l) per band 0 … order-1
    int nonzeros = 0;                                       ///< of all Â_l with l >= 2
    std::string sha256;                                     ///< of the file's bytes, hex; set by `read`
};

/// Largest cond_2(Y_l) a table may have in any band.
inline constexpr double kConditionCap = 50;

/// Fills `zeros`, `condition` and `nonzeros` of a table from its `order` and `directions`, at 50 digits. A
/// singular band has infinite condition and no zeros. Precondition: 2*order-1 directions.
void measure_lobe_table(LobeTable& table);

/// Reads a table and verifies it afresh at 50 digits. Throws `UserError` naming file, field,
/// value and next step when the file is missing, truncated, of another order, has a duplicate or non-unit
/// lobe, a singular band, one over `condition_cap`, or counts that its directions do not confirm.
LobeTable read_lobe_table(const std::filesystem::path& path, int order, double condition_cap = kConditionCap);

/// Writes under a temporary name beside `path`, then renames: a failed run leaves no half file. Precondition:
/// the table is measured and no band is singular.
void write_lobe_table(const std::filesystem::path& path, const LobeTable& table);

/// The path of an order's table inside a tables folder: orderNN.json.
std::filesystem::path lobe_table_name(int order);

}  // namespace zonal
