#pragma once

#include <string>

#include "search/search.hpp"

namespace zonal::search {

/// One line, at most 110 characters, for a person who waits.
std::string progress_text(const Progress& progress);

}  // namespace zonal::search
