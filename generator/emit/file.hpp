#pragma once

#include <string>

namespace zonal::emit {

/// A generated file before it is written.
struct File {
    std::string path;  ///< relative to the output folder
    std::string content;
};

}  // namespace zonal::emit
