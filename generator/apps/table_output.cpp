#include "apps/table_output.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "io/input_file.hpp"
#include "io/output_file.hpp"
#include "io/user_error.hpp"
#include "lobes/table_json.hpp"

namespace zonal {
namespace {

/// Sums of weights that differ by less are equal.
constexpr double kSameCost = 1e-6;

bool is_less(const std::pair<double, int>& a, const std::pair<double, int>& b) {
    return a.first < b.first - kSameCost || (a.first <= b.first + kSameCost && a.second < b.second);
}

}  // namespace

TableOutput::TableOutput(std::filesystem::path path, LobeUse use, double condition_cap, Cost cost)
    : path_(std::move(path)),
      use_(std::move(use)),
      condition_cap_(condition_cap),
      cost_(std::move(cost)),
      known_cost_(std::numeric_limits<double>::infinity(), 0) {
    cost_of_file();
}

void TableOutput::complain(const std::string& found, const std::string& wanted) const {
    throw UserError(
        fmt::format("--out {}: found {}, wanted {}, or no file yet; name another file, or move this one away",
                    path_.string(), found, wanted));
}

std::pair<double, int> TableOutput::cost_of_file() {
    if (!std::filesystem::exists(path_)) return {std::numeric_limits<double>::infinity(), 0};
    const std::string wanted =
        fmt::format("a table of {} {} for {}", use_.field, use_.value, name_of(use_.role));
    std::string bytes;
    try {
        bytes = read_file(path_);
    } catch (const Unreadable& error) {
        complain(fmt::format("a file that cannot be read ({})", error.what()), wanted);
    }
    if (bytes == known_bytes_) return known_cost_;
    LobeTable table;
    try {
        table = read_lobe_table(path_, use_);
    } catch (const UserError& error) {  // "<path>: <field>: found …, wanted …; <next step>"
        const std::string reason = std::string(error.what()).substr(path_.string().size() + 2);
        complain(fmt::format("another file ({})", reason.substr(0, reason.find("; "))), wanted);
    }
    const double condition = *std::ranges::max_element(table.condition);
    if (condition > condition_cap_)
        complain(fmt::format("a table of condition {:.6g}", condition),
                 fmt::format("at most the {} of --condition-cap", condition_cap_));
    known_bytes_ = std::move(bytes);
    known_cost_ = cost_(table);
    return known_cost_;
}

bool TableOutput::offer(const LobeTable& table) {
    const OutputLock lock(path_);  // another search may have written it meanwhile
    const std::pair<double, int> cost = cost_(table);
    const std::string bytes = json_of_table(table);
    if (!is_less(cost, cost_of_file())) return bytes == known_bytes_;
    write_file_atomically(path_, bytes);
    known_bytes_ = bytes;
    known_cost_ = cost;
    return true;
}

}  // namespace zonal
