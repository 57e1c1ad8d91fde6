#pragma once

#include <stdexcept>

namespace zonal {

/// Something the person at the command line can mend. The message names the file, the field, the value found,
/// the value wanted and the next step; `zonal-gen` prints it and exits with status 1.
struct UserError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

}  // namespace zonal
