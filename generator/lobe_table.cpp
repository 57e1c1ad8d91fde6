// Lobe tables as JSON files: read with suspicion, written whole or not at all.
// A table is believed only as far as its directions confirm it: zeros, nonzeros and conditions are computed
// afresh at 50 digits and compared with what the file claims.

#include "lobe_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <openssl/evp.h>

#include <array>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "exact/angles.hpp"
#include "output_file.hpp"
#include "user_error.hpp"

namespace zonal {
namespace {

using exact::Direction;
using exact::Real;
using Json = nlohmann::json;

const Real kUnitTolerance{"1e-38"};

/// Conditions are written with 6 digits.
constexpr double kConditionTolerance = 1e-4;

std::string next_step(const std::filesystem::path& path, const LobeUse& use) {
    return fmt::format("run: zonal-gen search --{} {} --out {}", use.field, use.value, path.string());
}

std::string read_bytes(const std::filesystem::path& path, const LobeUse& use) {
    std::ifstream file(path, std::ios::binary);
    if (!file) {
        throw UserError(fmt::format("{}: no such table, or it cannot be read; wanted the lobes of {} {}; {}",
                                    path.string(), use.field, use.value, next_step(path, use)));
    }
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return bytes.str();
}

std::string sha256_hex(const std::string& bytes) {
    unsigned char digest[EVP_MAX_MD_SIZE];
    unsigned int length = 0;
    if (EVP_Digest(bytes.data(), bytes.size(), digest, &length, EVP_sha256(), nullptr) != 1) {
        throw std::runtime_error("OpenSSL has no SHA-256");
    }
    std::string hex;
    for (unsigned int i = 0; i < length; ++i) hex += fmt::format("{:02x}", digest[i]);
    return hex;
}

/// One table on its way from bytes to a verified `LobeTable`; every complaint names file and field.
class Verifier {
  public:
    Verifier(const std::filesystem::path& path, const LobeUse& use) : path_(path) { table_.use = use; }

    LobeTable read(double condition_cap) {
        const std::string bytes = read_bytes(path_, table_.use);
        parse(bytes);
        table_.sha256 = sha256_hex(bytes);
        check_use();
        check_directions_are_unit();
        check_no_lobe_twice();
        check_angles();
        check_measurements(condition_cap);
        return table_;
    }

  private:
    [[noreturn]] void complain(const std::string& field, const std::string& found,
                               const std::string& wanted) const {
        throw UserError(fmt::format("{}: {}: found {}, wanted {}; {}", path_.string(), field, found, wanted,
                                    next_step(path_, table_.use)));
    }

    void parse(const std::string& bytes) {
        try {
            json_ = Json::parse(bytes);
        } catch (const Json::parse_error& error) {
            complain("JSON text", fmt::format("a break at byte {} of {}", error.byte, bytes.size()),
                     "a whole table (this one may be truncated)");
        }
        table_.seed = field<std::uint64_t>("seed", "a non-negative integer");
        table_.command = field<std::string>("command", "a text");
        table_.zeros = field<std::vector<int>>("zeros", "one integer a band");
        table_.condition = field<std::vector<double>>("cond", "one number a band");
        table_.nonzeros = field<int>("nonzeros", "an integer");
        for (const auto& xyz : field<std::vector<std::array<std::string, 3>>>(
                 "directions", "a list of [x, y, z], each a decimal in quotes")) {
            table_.directions.push_back({decimal(xyz[0]), decimal(xyz[1]), decimal(xyz[2])});
        }
        for (const auto& angles : field<std::vector<std::array<std::string, 2>>>(
                 "angles", "a list of [theta, phi], each a text")) {
            table_.angles.push_back({angles[0], angles[1]});
        }
    }

    template <class T>
    T field(const char* name, const char* wanted) const {
        if (!json_.is_object() || !json_.contains(name)) complain(name, "nothing", wanted);
        try {
            return json_.at(name).get<T>();
        } catch (const Json::exception&) {
            complain(name, json_.at(name).dump().substr(0, 80), wanted);
        }
    }

    Real decimal(const std::string& text) const {
        try {
            return Real{text};
        } catch (const std::runtime_error&) {
            complain("directions", '"' + text + '"', "a decimal number");
        }
    }

    void check_use() const {
        const LobeUse& use = table_.use;
        const int value = field<int>(use.field.c_str(), "an integer");
        if (value != use.value) complain(use.field, std::to_string(value), std::to_string(use.value));
        const std::size_t lobes = use.lobe_count();
        const auto check_count = [&](const char* name, std::size_t found, std::size_t wanted) {
            if (found != wanted) complain(name, fmt::format("{} entries", found), std::to_string(wanted));
        };
        check_count("directions", table_.directions.size(), lobes);
        check_count("angles", table_.angles.size(), lobes);
        check_count("zeros", table_.zeros.size(), use.bands.size());
        check_count("cond", table_.condition.size(), use.bands.size());
    }

    void check_directions_are_unit() const {
        for (std::size_t d = 0; d < table_.directions.size(); ++d) {
            const Real error = table_.directions[d].squaredNorm() - 1;
            if (!(abs(error) < kUnitTolerance)) {
                complain(
                    fmt::format("directions[{}]", d),
                    fmt::format("squared length 1 {} {}", error < 0 ? '-' : '+', Real(abs(error)).str(3)),
                    "a unit direction to 1e-38");
            }
        }
    }

    void check_no_lobe_twice() const {
        for (std::size_t d = 0; d < table_.directions.size(); ++d) {
            for (std::size_t other = 0; other < d; ++other) {
                const Real cosine = table_.directions[d].dot(table_.directions[other]);
                // 1 - cos is half the squared angle: lobes closer than 1e-10 are one.
                if (1 - abs(cosine) > Real{"1e-20"}) continue;
                complain(fmt::format("directions[{}]", d),
                         fmt::format("the lobe of directions[{}] again{}", other,
                                     cosine < 0 ? ", on its antipode (the same lobe up to sign)" : ""),
                         "a lobe of its own");
            }
        }
    }

    void check_angles() const {
        for (std::size_t d = 0; d < table_.angles.size(); ++d) {
            const auto& [theta, phi] = table_.angles[d];
            const std::string name = fmt::format("angles[{}]", d);
            const std::string found = fmt::format("[\"{}\", \"{}\"]", theta, phi);
            try {
                const Direction<Real> direction =
                    exact::direction_of(exact::evaluate_closed_form(theta), exact::evaluate_closed_form(phi));
                if ((direction - table_.directions[d]).norm() < kUnitTolerance) continue;
            } catch (const std::invalid_argument& error) {
                complain(name, error.what(), "closed forms or decimals (generator/tables/README.md)");
            }
            complain(name, found, fmt::format("the angles of directions[{}] to 1e-38", d));
        }
    }

    void check_measurements(double condition_cap) const {
        LobeTable measured = table_;
        measure_lobe_table(measured);
        for (std::size_t i = 0; i < table_.use.bands.size(); ++i) {
            const int l = table_.use.bands[i];
            const std::string cond = fmt::format("cond[{}]", i);
            const double condition = measured.condition[i];
            if (std::isinf(condition)) {
                complain(cond, fmt::format("singular lobes in band {}", l),
                         fmt::format("{} independent lobes", 2 * l + 1));
            }
            if (condition > condition_cap) {
                complain(cond, fmt::format("condition {:.6g}", condition),
                         fmt::format("at most {:g}", condition_cap));
            }
            if (!(std::abs(table_.condition[i] - condition) <= kConditionTolerance * condition)) {
                complain(cond, fmt::format("{:.6g}", table_.condition[i]),
                         fmt::format("{:.6g}, which the directions give", condition));
            }
            if (table_.zeros[i] != measured.zeros[i]) {
                complain(fmt::format("zeros[{}]", i), std::to_string(table_.zeros[i]),
                         fmt::format("{}, which the directions give", measured.zeros[i]));
            }
        }
        if (table_.nonzeros != measured.nonzeros) {
            complain("nonzeros", std::to_string(table_.nonzeros),
                     fmt::format("{}, which the directions give", measured.nonzeros));
        }
    }

    std::filesystem::path path_;
    Json json_;
    LobeTable table_;
};

/// JSON with a lobe a line, so that a changed lobe is a changed line.
std::string json_text(const LobeTable& table) {
    std::vector<std::string> directions, angles, conditions;
    for (const auto& direction : table.directions) {
        directions.push_back(fmt::format("    [\"{}\", \"{}\", \"{}\"]", exact::decimal_text(direction(0)),
                                         exact::decimal_text(direction(1)),
                                         exact::decimal_text(direction(2))));
    }
    for (const auto& [theta, phi] : table.angles) {
        angles.push_back(fmt::format("    [{}, {}]", Json(theta).dump(), Json(phi).dump()));
    }
    for (const double condition : table.condition) conditions.push_back(fmt::format("{:.6g}", condition));
    return fmt::format(
        "{{\n"
        "  \"{}\": {},\n"
        "  \"seed\": {},\n"
        "  \"command\": {},\n"
        "  \"directions\": [\n{}\n  ],\n"
        "  \"angles\": [\n{}\n  ],\n"
        "  \"zeros\": [{}],\n"
        "  \"cond\": [{}],\n"
        "  \"nonzeros\": {}\n"
        "}}\n",
        table.use.field, table.use.value, table.seed, Json(table.command).dump(),
        fmt::join(directions, ",\n"), fmt::join(angles, ",\n"), fmt::join(table.zeros, ", "),
        fmt::join(conditions, ", "), table.nonzeros);
}

}  // namespace

LobeUse LobeUse::order(int n) {
    LobeUse use{"order", n, {}};
    for (int l = 0; l < n; ++l) use.bands.push_back(l);
    return use;
}

LobeUse LobeUse::band(int l) { return {"band", l, {l}}; }

std::filesystem::path LobeUse::table_name() const { return fmt::format("{}{:02d}.json", field, value); }

std::filesystem::path LobeUse::mirrored_table_name() const { return "mirrored" / table_name(); }

std::filesystem::path LobeUse::conditioned_table_name() const { return "conditioned" / table_name(); }

void measure_lobe_table(LobeTable& table) {
    table.zeros.clear();
    table.condition.clear();
    table.nonzeros = 0;
    for (const int l : table.use.bands) {
        const exact::BandFactorization band = exact::factorize_band(l, table.directions);
        table.zeros.push_back(band.zeros);
        table.condition.push_back(band.condition);
        if (band.band >= 2) table.nonzeros += (2 * band.band + 1) * (2 * band.band + 1) - band.zeros;
    }
}

LobeTable read_lobe_table(const std::filesystem::path& path, const LobeUse& use, double condition_cap) {
    return Verifier(path, use).read(condition_cap);
}

void write_lobe_table(const std::filesystem::path& path, const LobeTable& table) {
    write_file_atomically(path, json_text(table));
}

}  // namespace zonal
