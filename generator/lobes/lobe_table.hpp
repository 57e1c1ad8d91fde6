#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "lobes/factorization.hpp"
#include "lobes/lobe.hpp"
#include "lobes/lobe_use.hpp"

namespace zonal {

/// Saved lobe directions and how they were found. Schema: generator/tables/README.md.
struct LobeTable {
    LobeUse use;
    std::uint64_t seed = 0;
    std::string command;
    std::vector<Lobe> lobes;               ///< as many as `use` has
    std::vector<int> zeros;                ///< per band of `use`
    std::vector<double> condition;         ///< cond_2(Y_l) per band of `use`
    int nonzeros = 0;                      ///< of all Â_l with l >= 2
    std::string sha256;                    ///< of the file's bytes, hex; set by `read`
    std::vector<BandFactorization> bands;  ///< of `use`, in that order: not in the file, but made of `lobes`

    /// The digits of `sha256` by which banners and the file of bounds name the table.
    std::string short_hash() const { return sha256.substr(0, 16); }
};

/// Largest cond_2(Y_l) a table may have in any band.
inline constexpr double kConditionCap = 50;

/// Factorizes the bands at 50 digits, and fills `zeros`, `condition` and `nonzeros` from that. A singular
/// band has infinite condition and no zeros. Precondition: `use.lobe_count()` lobes.
void factorize(LobeTable& table);

/// Reads a table and verifies it afresh at 50 digits; its factorizations come with it, so that nothing is
/// inverted again. Throws `UserError` naming file, field, value and next step when the file is missing,
/// truncated, for another use, has a duplicate or non-unit lobe, a singular band, one over `condition_cap`,
/// or counts that its directions do not confirm.
LobeTable read_lobe_table(const std::filesystem::path& path, const LobeUse& use,
                          double condition_cap = kConditionCap);

/// The same of that order or band, whatever it is for.
LobeTable read_lobe_table_of_any_role(const std::filesystem::path& path, const LobeUse& use);

/// Writes under a temporary name beside `path`, then renames: a failed run leaves no half file. Precondition:
/// the table is factorized and no band is singular.
void write_lobe_table(const std::filesystem::path& path, const LobeTable& table);

}  // namespace zonal
