#pragma once

#include <stdexcept>
#include <string>

#include "zonal/api.hpp"

namespace zonal {

/// What a user needs to know to mend a mistake. `file` is empty when no file is involved.
struct Problem {
    std::string file = {};
    std::string field;      ///< what is wrong: "order", "texel (3, 7) green"
    std::string found;      ///< the value found
    std::string wanted;     ///< the values that would be right
    std::string next_step;  ///< what to do about it
};

/// The one exception that leaves the runtime (besides std::bad_alloc).
/// what(): "<file>: <field>: found <found>, wanted <wanted>; <next step>", on one line.
class ZONAL_API Error : public std::runtime_error {
  public:
    explicit Error(const Problem& problem);
};

}  // namespace zonal
