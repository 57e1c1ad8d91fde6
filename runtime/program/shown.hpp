#pragma once

#include <string>
#include <string_view>

namespace zonal::program {

/// A text of somebody's file or argument for a terminal: control characters, marks that reverse the direction
/// of writing, and bytes that are no UTF-8 appear as \xNN, on one line.
std::string shown(std::string_view text);

/// The same where standard output is a terminal; for a pipe or a file the text itself.
std::string shown_on_stdout(std::string_view text);

}  // namespace zonal::program
