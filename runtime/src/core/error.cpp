#include "zonal/error.hpp"

#include "text.hpp"

namespace zonal {
namespace {

std::string message_of(const Problem& problem) {
    const std::string where = problem.file.empty() ? "" : problem.file + ": ";
    return joined(where, problem.field, ": found ", problem.found, ", wanted ", problem.wanted, "; ",
                  problem.next_step);
}

}  // namespace

Error::Error(const Problem& problem) : std::runtime_error(message_of(problem)) {}

}  // namespace zonal
