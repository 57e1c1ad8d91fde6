// The Pareto front of searches as a JSON file, which later searches add to. Like a table it is believed only
// as far as its angles confirm it.
#include "apps/front_file.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>

#include "exact/angles.hpp"
#include "io/input_file.hpp"
#include "io/json_text.hpp"
#include "io/output_file.hpp"
#include "io/user_error.hpp"
#include "search/front.hpp"

namespace zonal {
namespace {

/// The file has every digit, but its lobes in another order than those that were scored: sums round
/// otherwise.
constexpr double kConditionTolerance = 1e-9;

class Reader {
  public:
    Reader(const std::filesystem::path& path, const LobeUse& use) : path_(path), use_(use) {}

    std::vector<FoundSet> read(const search::Problem& problem) const {
        Json json;
        try {
            json = parse_json(read_file(path_));
        } catch (const Unreadable& error) {
            complain("file", fmt::format("nothing that can be read ({})", error.what()), "an archive");
        } catch (const WrongJson& error) {
            complain("JSON text", error.what(), "a whole archive");
        }
        const int value = field<int>(json, "", use_.field.c_str(), "an integer");
        if (value != use_.value) complain(use_.field, std::to_string(value), std::to_string(use_.value));
        std::vector<FoundSet> front;
        for (const Json& set : field<std::vector<Json>>(json, "", "sets", "a list"))
            front.push_back(read_set(set, fmt::format("sets[{}].", front.size()), problem));
        return front;
    }

  private:
    [[noreturn]] void complain(const std::string& name, const std::string& found,
                               const std::string& wanted) const {
        throw UserError(
            fmt::format("--archive {}: {}: found {}, wanted {}; name another file, or move this one away",
                        path_.string(), name, found, wanted));
    }

    template <class T>
    T field(const Json& json, const std::string& place, const char* name, const char* wanted) const {
        return field_as<T>(json, name,
                           [&](const std::string& found) { complain(place + name, found, wanted); });
    }

    FoundSet read_set(const Json& json, const std::string& place, const search::Problem& problem) const {
        const auto angles = field<std::vector<std::array<std::string, 2>>>(
            json, place, "angles", "a list of [theta, phi], each a text");
        if (static_cast<int>(angles.size()) != use_.lobe_count())
            complain(place + "angles", fmt::format("{} lobes", angles.size()),
                     std::to_string(use_.lobe_count()));
        FoundSet set;
        try {
            search::AngledSet lobes;
            for (const auto& [theta, phi] : angles) lobes.push_back(angled_lobe(theta, phi));
            static_cast<search::Solution&>(set) = search::confirm(problem, lobes);
        } catch (const std::invalid_argument& error) {
            complain(place + "angles", error.what(), "closed forms or decimals (generator/tables/README.md)");
        }
        set.command = field<std::string>(json, place, "command", "a text");
        check(json, place, "nonzeros", set.score.nonzeros);
        check(json, place, "multiplications", set.score.multiplications);
        const auto condition = field<double>(json, place, "cond", "a number");
        if (!(std::abs(condition - set.score.condition) <= kConditionTolerance * condition))
            complain(place + "cond", fmt::format("{:.10g}", condition),
                     fmt::format("{:.10g}, which the angles give", set.score.condition));
        return set;
    }

    void check(const Json& json, const std::string& place, const char* name, int given_by_angles) const {
        const int found = field<int>(json, place, name, "an integer");
        if (found != given_by_angles)
            complain(place + name, std::to_string(found),
                     fmt::format("{}, which the angles give", given_by_angles));
    }

    std::filesystem::path path_;
    LobeUse use_;
};

}  // namespace

search::AngledLobe angled_lobe(const std::string& theta, const std::string& phi) {
    return {{exact::evaluate_closed_form(theta), theta}, {exact::evaluate_closed_form(phi), phi}};
}

std::vector<FoundSet> read_front(const std::filesystem::path& path, const LobeUse& use,
                                 const search::Problem& problem) {
    if (!std::filesystem::exists(path)) return {};
    return Reader(path, use).read(problem);
}

void write_front(const std::filesystem::path& path, const LobeUse& use, std::vector<FoundSet> front) {
    search::sort_front(front);
    Json sets = Json::array();
    for (const FoundSet& set : front) {
        Json angles = Json::array();
        for (const search::AngledLobe& lobe : search::in_reading_order(set.lobes))
            angles.push_back({lobe.theta.text, lobe.phi.text});
        sets.push_back({{"nonzeros", set.score.nonzeros},
                        {"multiplications", set.score.multiplications},
                        {"cond", set.score.condition},
                        {"command", set.command},
                        {"angles", angles}});
    }
    write_file_atomically(path, Json{{use.field, use.value}, {"sets", sets}}.dump(2) + "\n");
}

}  // namespace zonal
