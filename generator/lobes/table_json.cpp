#include "lobes/table_json.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <stdexcept>

#include "exact/angles.hpp"
#include "io/json_text.hpp"

namespace zonal {
namespace {

using exact::Real;

class Reader {
  public:
    Reader(const std::string& text, const TableComplaints& complaints) : complaints_(complaints) {
        try {
            json_ = parse_json(text);
        } catch (const WrongJson& error) {
            complaints_.complain("JSON text", error.what(), "a whole table (this one may be truncated)");
        }
    }

    LobeTable read(const LobeUse& use) const {
        check_use(use);
        LobeTable table;
        table.use = use;
        table.seed = field<std::uint64_t>("seed", "a non-negative integer");
        table.command = field<std::string>("command", "a text");
        table.zeros = field<std::vector<int>>("zeros", "one integer a band");
        table.condition = field<std::vector<double>>("cond", "one number a band");
        table.nonzeros = field<int>("nonzeros", "an integer");
        const auto directions = field<std::vector<std::array<std::string, 3>>>(
            "directions", "a list of [x, y, z], each a decimal in quotes");
        const auto angles =
            field<std::vector<std::array<std::string, 2>>>("angles", "a list of [theta, phi], each a text");
        table.use.role = role(use);
        check_count("directions", directions.size(), use.lobe_count());
        check_count("angles", angles.size(), use.lobe_count());
        check_count("zeros", table.zeros.size(), use.bands.size());
        check_count("cond", table.condition.size(), use.bands.size());
        for (std::size_t d = 0; d < directions.size(); ++d) {
            const auto& [x, y, z] = directions[d];
            table.lobes.push_back({{decimal(x), decimal(y), decimal(z)}, angles[d][0], angles[d][1]});
        }
        return table;
    }

  private:
    [[noreturn]] void complain(const std::string& name, const std::string& found,
                               const std::string& wanted) const {
        complaints_.complain(name, found, wanted);
    }

    template <class T>
    T field(const char* name, const char* wanted) const {
        return field_as<T>(json_, name, [&](const std::string& found) { complain(name, found, wanted); });
    }

    TableRole role(const LobeUse& use) const {
        const char* const wanted =
            use.field == "order" ? "\"shared\" or \"rotate_zhf\"" : "\"band\" or \"band_mirrored\"";
        const auto name = field<std::string>("for", wanted);
        const std::optional<TableRole> role = role_named(name);
        if (!role || !use.may_be(*role)) complain("for", '"' + name + '"', wanted);
        return *role;
    }

    /// Before all else: of a table for something else nothing is amiss.
    void check_use(const LobeUse& use) const {
        const char* const other = use.field == "order" ? "band" : "order";
        if (json_.is_object() && !json_.contains(use.field) && json_.contains(other))
            complaints_.of_another_use(other, shown_value(json_.at(other)),
                                       fmt::format("a table of {} {}", use.field, use.value));
        const int value = field<int>(use.field.c_str(), "an integer");
        if (value != use.value)
            complaints_.of_another_use(use.field, std::to_string(value), std::to_string(use.value));
    }

    void check_count(const char* name, std::size_t found, std::size_t wanted) const {
        if (found != wanted) complain(name, fmt::format("{} entries", found), std::to_string(wanted));
    }

    Real decimal(const std::string& text) const {
        try {
            return Real{text};
        } catch (const std::runtime_error&) {
            complain("directions", '"' + text + '"', "a decimal number");
        }
    }

    const TableComplaints& complaints_;
    Json json_;
};

}  // namespace

LobeTable table_of_json(const std::string& text, const LobeUse& use, const TableComplaints& complaints) {
    return Reader(text, complaints).read(use);
}

std::string json_of_table(const LobeTable& table) {
    std::vector<std::string> directions, angles, conditions;
    for (const Lobe& lobe : table.lobes) {
        directions.push_back(
            fmt::format("    [\"{}\", \"{}\", \"{}\"]", exact::decimal_text(lobe.direction(0)),
                        exact::decimal_text(lobe.direction(1)), exact::decimal_text(lobe.direction(2))));
        angles.push_back(fmt::format("    [{}, {}]", Json(lobe.theta).dump(), Json(lobe.phi).dump()));
    }
    for (const double condition : table.condition) conditions.push_back(fmt::format("{:.6g}", condition));
    return fmt::format(
        "{{\n"
        "  \"{}\": {},\n"
        "  \"for\": \"{}\",\n"
        "  \"seed\": {},\n"
        "  \"command\": {},\n"
        "  \"directions\": [\n{}\n  ],\n"
        "  \"angles\": [\n{}\n  ],\n"
        "  \"zeros\": [{}],\n"
        "  \"cond\": [{}],\n"
        "  \"nonzeros\": {}\n"
        "}}\n",
        table.use.field, table.use.value, name_of(table.use.role), table.seed, Json(table.command).dump(),
        fmt::join(directions, ",\n"), fmt::join(angles, ",\n"), fmt::join(table.zeros, ", "),
        fmt::join(conditions, ", "), table.nonzeros);
}

}  // namespace zonal
