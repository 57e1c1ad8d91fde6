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

/// What lobes are for: all bands of an order, which share them, or one band alone.
struct LobeUse {
    std::string field;       ///< of the file that says it: "order" or "band"
    int value = 0;           ///< its value: N, or l
    std::vector<int> bands;  ///< ascending: 0 … N-1, or l

    static LobeUse order(int n);
    static LobeUse band(int l);

    /// Band l uses the first 2l+1 lobes.
    int lobe_count() const { return 2 * bands.back() + 1; }
    /// Name of its table inside a tables folder: orderNN.json, bandLL.json.
    std::filesystem::path table_name() const;
    /// The same of the lobes closed under mirrors: mirrored/bandLL.json.
    std::filesystem::path mirrored_table_name() const;
    /// The same of the lobes under a lower cap on the condition: conditioned/orderNN.json.
    std::filesystem::path conditioned_table_name() const;
};

/// Saved lobe directions and how they were found. Schema: generator/tables/README.md.
struct LobeTable {
    LobeUse use;
    std::uint64_t seed = 0;
    std::string command;
    std::vector<exact::Direction<exact::Real>> directions;  ///< unit, as many as `use` has lobes
    std::vector<LobeAngles> angles;                         ///< one per direction
    std::vector<int> zeros;                                 ///< per band of `use`
    std::vector<double> condition;                          ///< cond_2(Y_l) per band of `use`
    int nonzeros = 0;                                       ///< of all Â_l with l >= 2
    std::string sha256;                                     ///< of the file's bytes, hex; set by `read`

    /// The digits of `sha256` by which banners and the file of bounds name the table.
    std::string short_hash() const { return sha256.substr(0, 16); }
};

/// Largest cond_2(Y_l) a table may have in any band.
inline constexpr double kConditionCap = 50;

/// Fills `zeros`, `condition` and `nonzeros` of a table from its `use` and `directions`, at 50 digits. A
/// singular band has infinite condition and no zeros. Precondition: `use.lobe_count()` directions.
void measure_lobe_table(LobeTable& table);

/// Reads a table and verifies it afresh at 50 digits. Throws `UserError` naming file, field,
/// value and next step when the file is missing, truncated, for another use, has a duplicate or non-unit
/// lobe, a singular band, one over `condition_cap`, or counts that its directions do not confirm.
LobeTable read_lobe_table(const std::filesystem::path& path, const LobeUse& use,
                          double condition_cap = kConditionCap);

/// Writes under a temporary name beside `path`, then renames: a failed run leaves no half file. Precondition:
/// the table is measured and no band is singular.
void write_lobe_table(const std::filesystem::path& path, const LobeTable& table);

}  // namespace zonal
