#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <utility>

#include "lobes/lobe_table.hpp"

namespace zonal {

/// The file a search leaves its best lobes in. A table that is there already stays unless a better one is
/// offered, also one that another search puts there meanwhile; whatever else is there is refused.
class TableOutput {
  public:
    /// What a table costs, the less the better: first what its products cost, then what breaks ties.
    using Cost = std::function<std::pair<double, int>(const LobeTable&)>;

    /// Looks at what is there, before the search. Throws `UserError` where it is not a table of that use, or
    /// its condition is over the cap of this search, which cannot be compared.
    TableOutput(std::filesystem::path path, LobeUse use, double condition_cap, Cost cost);

    /// Writes the table unless one as good is there; says whether it did, or those very bytes are there.
    bool offer(const LobeTable& table);

  private:
    /// Of the file as it is now; infinite where there is none.
    std::pair<double, int> cost_of_file();
    [[noreturn]] void complain(const std::string& found, const std::string& wanted) const;

    std::filesystem::path path_;
    LobeUse use_;
    double condition_cap_;
    Cost cost_;
    std::string known_bytes_;  ///< of the file when its cost was last reckoned
    std::pair<double, int> known_cost_;
};

}  // namespace zonal
