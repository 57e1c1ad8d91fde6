#include "lobes/table_check.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>

#include "exact/angles.hpp"

namespace zonal {
namespace {

using exact::Real;

const Real kUnitTolerance{"1e-38"};

/// Conditions are written with 6 digits.
constexpr double kConditionTolerance = 1e-4;

void check_directions_are_unit(const LobeTable& table, const TableComplaints& complaints) {
    for (std::size_t d = 0; d < table.lobes.size(); ++d) {
        const Real error = table.lobes[d].direction.squaredNorm() - 1;
        if (abs(error) < kUnitTolerance) continue;
        complaints.complain(fmt::format("directions[{}]", d),
                            fmt::format("squared length 1 {} {}", error < 0 ? '-' : '+', abs(error).str(3)),
                            "a unit direction to 1e-38");
    }
}

void check_no_lobe_twice(const LobeTable& table, const TableComplaints& complaints) {
    // 1 - cos is half the squared angle: lobes closer than 1e-10 are one.
    const Real same{"1e-20"};
    for (std::size_t d = 0; d < table.lobes.size(); ++d) {
        for (std::size_t other = 0; other < d; ++other) {
            const Real cosine = table.lobes[d].direction.dot(table.lobes[other].direction);
            if (1 - abs(cosine) > same) continue;
            complaints.complain(fmt::format("directions[{}]", d),
                                fmt::format("the lobe of directions[{}] again{}", other,
                                            cosine < 0 ? ", on its antipode (the same lobe up to sign)" : ""),
                                "a lobe of its own");
        }
    }
}

void check_angles(const LobeTable& table, const TableComplaints& complaints) {
    for (std::size_t d = 0; d < table.lobes.size(); ++d) {
        const Lobe& lobe = table.lobes[d];
        const std::string name = fmt::format("angles[{}]", d);
        try {
            const Lobe given = Lobe::at(lobe.theta, lobe.phi);
            if ((given.direction - lobe.direction).norm() < kUnitTolerance) continue;
        } catch (const std::invalid_argument& error) {
            complaints.complain(name, error.what(), "closed forms or decimals (generator/tables/README.md)");
        }
        complaints.complain(name, fmt::format("[\"{}\", \"{}\"]", lobe.theta, lobe.phi),
                            fmt::format("the angles of directions[{}] to 1e-38", d));
    }
}

void check_measurements(const LobeTable& claimed, const LobeTable& measured, double condition_cap,
                        const TableComplaints& complaints) {
    for (std::size_t i = 0; i < claimed.use.bands.size(); ++i) {
        const int l = claimed.use.bands[i];
        const std::string cond = fmt::format("cond[{}]", i);
        const double condition = measured.condition[i];
        if (std::isinf(condition))
            complaints.complain(cond, fmt::format("singular lobes in band {}", l),
                                fmt::format("{} independent lobes", 2 * l + 1));
        if (condition > condition_cap)
            complaints.complain(cond, fmt::format("condition {:.6g}", condition),
                                fmt::format("at most {:g}", condition_cap));
        if (!(std::abs(claimed.condition[i] - condition) <= kConditionTolerance * condition))
            complaints.complain(cond, fmt::format("{:.6g}", claimed.condition[i]),
                                fmt::format("{:.6g}, which the directions give", condition));
        if (claimed.zeros[i] != measured.zeros[i])
            complaints.complain(fmt::format("zeros[{}]", i), std::to_string(claimed.zeros[i]),
                                fmt::format("{}, which the directions give", measured.zeros[i]));
    }
    if (claimed.nonzeros != measured.nonzeros)
        complaints.complain("nonzeros", std::to_string(claimed.nonzeros),
                            fmt::format("{}, which the directions give", measured.nonzeros));
}

}  // namespace

void check_table(LobeTable& table, double condition_cap, const TableComplaints& complaints) {
    check_directions_are_unit(table, complaints);
    check_no_lobe_twice(table, complaints);
    check_angles(table, complaints);
    LobeTable measured = table;
    factorize(measured);
    check_measurements(table, measured, condition_cap, complaints);
    table.bands = std::move(measured.bands);
}

}  // namespace zonal
