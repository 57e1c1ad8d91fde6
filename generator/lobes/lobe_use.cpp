#include "lobes/lobe_use.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace zonal {
namespace {

constexpr std::array<std::pair<TableRole, const char*>, 4> kRoles{
    {{TableRole::shared, "shared"},
     {TableRole::rotate_zhf, "rotate_zhf"},
     {TableRole::band, "band"},
     {TableRole::band_mirrored, "band_mirrored"}}};

bool is_of_order(TableRole role) { return role == TableRole::shared || role == TableRole::rotate_zhf; }

}  // namespace

std::string name_of(TableRole role) { return kRoles[static_cast<std::size_t>(role)].second; }

std::optional<TableRole> role_named(const std::string& name) {
    for (const auto& [role, known] : kRoles)
        if (name == known) return role;
    return std::nullopt;
}

LobeUse LobeUse::order(int n, TableRole role) {
    LobeUse use{role, "order", n, {}};
    for (int l = 0; l < n; ++l) use.bands.push_back(l);
    return use;
}

LobeUse LobeUse::band(int l, TableRole role) { return {role, "band", l, {l}}; }

bool LobeUse::may_be(TableRole other) const { return is_of_order(role) == is_of_order(other); }

std::filesystem::path LobeUse::table_path() const {
    return std::filesystem::path(name_of(role)) / fmt::format("{}{:02d}.json", field, value);
}

bool LobeUse::is_published() const {
    constexpr std::array kOrdersOfRotateZhf{8, 9, 10, 11, 12, 13, 16};
    switch (role) {
        case TableRole::shared:
            return value >= 3 && value <= 20;
        case TableRole::rotate_zhf:
            return std::ranges::count(kOrdersOfRotateZhf, value) > 0;
        case TableRole::band:
            return value >= 2 && value <= 18;
        case TableRole::band_mirrored:
            return value >= 4 && value <= 18;
    }
    return false;
}

std::string LobeUse::options() const {
    const char* const more = role == TableRole::rotate_zhf      ? " --for rotate_zhf --condition-cap 20"
                             : role == TableRole::band_mirrored ? " --mirrors 1"
                                                                : "";
    return fmt::format("--{} {}{}", field, value, more);
}

}  // namespace zonal
