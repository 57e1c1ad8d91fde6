#include "bounds/published.hpp"

#include <fmt/format.h>

#include <cmath>

#include "bounds/body_hash.hpp"
#include "bounds/derived.hpp"
#include "io/input_file.hpp"
#include "io/json_text.hpp"
#include "io/user_error.hpp"
#include "lobes/tables_folder.hpp"
#include "program/numbers.hpp"

namespace zonal {
namespace {

[[noreturn]] void complain(const std::string& path, const std::string& field, const std::string& found,
                           const std::string& wanted) {
    throw UserError(fmt::format(
        "{}: {}: found {}, wanted {}; restore the file, or measure all bounds anew: zonal-measure-bounds "
        "--out NEW.json",
        path, field, found, wanted));
}

/// A derived bound that is two hundred times what was measured tells nobody anything: none then.
Bound with_derived(Bound bound, const graph::Kernel& kernel) {
    constexpr double kFloat = 0x1p-24, kDouble = 0x1p-53, kMost = 200;
    constexpr int kLargestGraph = 2000;  // others take seconds, and their bounds grow with every band
    if (kernel.graph.size() > kLargestGraph) return bound;
    const std::optional<DerivedBound> derived = derived_bound(kernel);
    if (!derived || derived->apart * kFloat > kMost * std::stod(bound.float_text)) return bound;
    bound.float_derived = rounded_up(derived->fused * kFloat);
    bound.double_derived = rounded_up(derived->fused * kDouble);
    bound.float_apart_derived = rounded_up(derived->apart * kFloat);
    bound.double_apart_derived = rounded_up(derived->apart * kDouble);
    return bound;
}

}  // namespace

std::string rounded_up(double bound) {
    const double unit = std::pow(10.0, std::floor(std::log10(bound)) - 1);
    return fmt::format("{:.1e}", std::ceil(bound / unit) * unit);
}

std::filesystem::path bounds_file() { return (tables_folder() / "../bounds/bounds.json").lexically_normal(); }

std::vector<MeasuredBound> read_bounds(const std::filesystem::path& path) {
    const std::string name = path.string();
    Json file;
    try {
        file = parse_json(read_file(path));
    } catch (const Unreadable& error) {
        complain(name, "file", fmt::format("nothing that can be read ({})", error.what()),
                 "the error bounds that banners publish");
    } catch (const WrongJson& error) {
        complain(name, "JSON text", error.what(), "a whole file of bounds (this one may be truncated)");
    }
    std::vector<MeasuredBound> bounds;
    const auto list = field_as<std::vector<Json>>(
        file, "bounds", [&](const std::string& found) { complain(name, "bounds", found, "a list"); });
    for (const Json& entry : list) {
        const auto refuse = [&](const char* field, const char* wanted) {
            return [&name, &bounds, field, wanted](const std::string& found) {
                complain(name, fmt::format("bounds[{}].{}", bounds.size(), field), found, wanted);
            };
        };
        const auto decimal = [&](const char* field) {  // goes into generated code as it stands
            const auto number = field_as<std::string>(entry, field, refuse(field, "a text"));
            if (!program::number_in(number, program::above(0, 1e6)))
                refuse(field, "a positive decimal")(shown_value(Json(number)));
            return number;
        };
        MeasuredBound measured;
        measured.order = field_as<int>(entry, "order", refuse("order", "a whole number"));
        measured.body = field_as<std::string>(entry, "body", refuse("body", "a text"));
        measured.kernels =
            field_as<std::vector<std::string>>(entry, "kernels", refuse("kernels", "a list of texts"));
        measured.bound.float_text = decimal("float");
        measured.bound.double_text = decimal("double");
        measured.bound.float_apart = decimal("float_apart");
        measured.bound.double_apart = decimal("double_apart");
        measured.bound.shader = decimal("shader");
        measured.bound.excess_text = decimal("excess");
        bounds.push_back(std::move(measured));
    }
    return bounds;
}

std::map<std::string, Bound> published_bounds(const OrderKernels& order) {
    const std::filesystem::path path = bounds_file();
    std::map<std::string, Bound> by_body;
    for (const MeasuredBound& measured : read_bounds(path))
        if (measured.order == order.order) by_body[measured.body] = measured.bound;
    std::map<std::string, Bound> published;
    for (const graph::Kernel& kernel : order.kernels) {
        if (!kernel.has_bound) continue;
        const std::string body = body_hash(kernel, order.kernels);
        if (by_body.contains(body)) {
            published[kernel.full_name()] = with_derived(by_body.at(body), kernel);
            continue;
        }
        const OrderTables& tables = order.tables;
        if (kernel.needs_lobes && tables.chosen && tables.rotate_zhf == tables.chosen) continue;
        throw UserError(fmt::format(
            "{}: bounds: found none of {} of order {} with the body {}, wanted one; restore the tables and "
            "this file, or, after a change of either or of the kernel, measure: zonal-measure-bounds "
            "--missing --orders {} --out {}",
            path.string(), kernel.full_name(), order.order, body, order.order, path.string()));
    }
    return published;
}

}  // namespace zonal
