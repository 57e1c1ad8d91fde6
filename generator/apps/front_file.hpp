#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lobes/lobe_use.hpp"
#include "search/search.hpp"

namespace zonal {

/// A set of lobes that no other of its file beats, and the command that found it.
struct FoundSet : search::Solution {
    std::string command;
};

/// The lobe that angles as text give. Throws std::invalid_argument that quotes a text it cannot read.
search::AngledLobe angled_lobe(const std::string& theta, const std::string& phi);

/// The sets of an archive, each scored afresh at 50 digits; none where there is no file yet. Throws
/// `UserError` naming file, field, value and next step when it is truncated, for another use, or claims what
/// its angles do not confirm.
std::vector<FoundSet> read_front(const std::filesystem::path& path, const LobeUse& use,
                                 const search::Problem& problem);

/// {"order" or "band": …, "sets": [{"nonzeros", "multiplications", "cond", "command", "angles"}, …]}, fewest
/// nonzeros first; whole or not at all.
void write_front(const std::filesystem::path& path, const LobeUse& use, std::vector<FoundSet> front);

}  // namespace zonal
