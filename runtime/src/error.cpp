#include "zonal/error.hpp"

#include <fmt/format.h>

namespace zonal {
namespace {

std::string message_of(const Problem& problem) {
    const std::string where = problem.file.empty() ? "" : problem.file + ": ";
    return fmt::format("{}{}: found {}, wanted {}; {}", where, problem.field, problem.found, problem.wanted,
                       problem.next_step);
}

}  // namespace

Error::Error(const Problem& problem) : std::runtime_error(message_of(problem)) {}

}  // namespace zonal
