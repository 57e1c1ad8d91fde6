#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace zonal {

/// Which kernels a table is for; the names are those of the field `for` and of the folders.
enum class TableRole {
    shared,         ///< lobes that all bands of an order share: most zeros
    rotate_zhf,     ///< the same under a lower cap on the condition, for the kernel of that name alone
    band,           ///< lobes of one band's own: most zeros
    band_mirrored,  ///< the same closed under mirrors: fewest instructions
};

std::string name_of(TableRole role);
std::optional<TableRole> role_named(const std::string& name);

/// What lobes are for: all bands of an order, which share them, or one band alone.
struct LobeUse {
    TableRole role = TableRole::shared;
    std::string field;       ///< of the file that says what `value` is: "order" or "band"
    int value = 0;           ///< N, or l
    std::vector<int> bands;  ///< ascending: 0 … N-1, or l

    static LobeUse order(int n, TableRole role = TableRole::shared);
    static LobeUse band(int l, TableRole role = TableRole::band);

    /// Whether lobes of such a role are of an order, or of a band, as these are.
    bool may_be(TableRole other) const;
    /// Band l uses the first 2l+1 lobes.
    int lobe_count() const { return 2 * bands.back() + 1; }
    /// Where its table lies inside a tables folder: shared/orderNN.json, band_mirrored/bandLL.json.
    std::filesystem::path table_path() const;
    /// Whether the tables that come with the program have one, so that it is an error where it is missing.
    bool is_published() const;
    /// Options of `search` that find such lobes: "--order 4", "--band 7 --mirrors 1".
    std::string options() const;
};

}  // namespace zonal
