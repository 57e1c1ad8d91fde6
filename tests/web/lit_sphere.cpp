// zonal-lit-sphere: writes the scene that lit_sphere.html renders, and judges what the browser made of it.
//
// Two judges for every number: the runtime's own rotation in C++ (float, three channels), and the oracle,
// which turns directions, not coefficients, and shares no code with either. With b the published bound of
// `rotate` in float, x its excess, e = |R R^T - I|_F, |f| the norm of a channel of the light, w the pixel's
// weights:
//   turned light : |f'_page - f'_oracle| <= (b + x e) |f|, and twice that to C++
//   pixel        : |page - oracle| <= |w| (b + x e) |f| + shading_error sum_i W_i (|f'_i| + (b + x e) |f|),
//                  and |w| (b + x e) |f| more to C++, whose shading is in double
// The shader calls `rotate` on vec3, which may be `rotate_channels` inside: b and x are the larger of both.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "program/program.hpp"
#include "support/banner.hpp"
#include "support/oracle.hpp"
#include "web/scene.hpp"
#include "web/shading.hpp"
#include "zonal/rotate.hpp"

namespace {

using zonal::web::Scene;
using Channels = std::array<std::vector<double>, 3>;  // [channel][coefficient]
using Pixel = std::array<float, 4>;

static_assert(std::endian::native == std::endian::little, "values.f32 is little-endian");

std::vector<Pixel> read_values(const std::filesystem::path& path, std::size_t wanted) {
    std::error_code failure;
    const auto bytes = std::filesystem::file_size(path, failure);
    if (failure || bytes != wanted * sizeof(Pixel)) {
        throw std::runtime_error(fmt::format(
            "{}: found {}, wanted {} bytes of the scene's pictures; render them again", path.string(),
            failure ? failure.message() : fmt::format("{} bytes", bytes), wanted * sizeof(Pixel)));
    }
    std::vector<Pixel> values(wanted);
    std::ifstream file(path, std::ios::binary);
    file.read(reinterpret_cast<char*>(values.data()), static_cast<std::streamsize>(bytes));
    if (!file) throw std::runtime_error(fmt::format("{}: cannot be read", path.string()));
    return values;
}

double norm(const std::vector<double>& v) {
    double sum = 0;
    for (const double value : v) sum += value * value;
    return std::sqrt(sum);
}

Channels channels(std::span<const zonal::Rgb<float>> values) {
    Channels result;
    for (const auto& value : values) {
        result[0].push_back(value.r);
        result[1].push_back(value.g);
        result[2].push_back(value.b);
    }
    return result;
}

/// Differences of one kind as shares of what is allowed, and the largest of them with its place.
class Verdict {
  public:
    explicit Verdict(std::string kind) : kind_(std::move(kind)) {}

    template <class Place>
    void add(double found, double wanted, double tolerance, const Place& place) {
        const double difference = std::abs(found - wanted);
        largest_difference_ = std::max(largest_difference_, difference);
        const double share = difference / tolerance;
        if (share <= share_) return;
        share_ = std::isnan(share) ? HUGE_VAL : share;
        where_ =
            fmt::format("{}: found {:.9g}, wanted {:.9g} within {:.2g}", place(), found, wanted, tolerance);
    }
    bool is_met() const { return share_ <= 1; }
    void print() const {
        fmt::print("  {:<24} {:.2g}, {:.3f} of what is allowed{}\n", kind_, largest_difference_, share_,
                   is_met() ? "" : "; " + where_);
    }

  private:
    std::string kind_;
    double largest_difference_ = 0;
    double share_ = 0;
    std::string where_;
};

struct Judge {
    const Scene& scene;
    int order;
    zonal::oracle::Rotation exact{order};
    Verdict light_oracle{"turned light, oracle"}, light_cpp{"turned light, C++"};
    Verdict pixel_oracle{"pixels, oracle"}, pixel_cpp{"pixels, C++"};
    std::size_t wrong_coverage = 0;

    /// One picture: the turned light, then the pixels.
    void picture(int turn, std::span<const Pixel> light, std::span<const Pixel> pixels) {
        const int count = order * order;
        const std::span<const zonal::Rgb<float>> probe = std::span(scene.light).first(count);
        const auto& rotation = scene.rotations[turn];
        std::vector<zonal::Rgb<float>> turned(count);
        zonal::rotate(order, rotation, probe, std::span(turned));
        const Channels f = channels(probe);
        const Channels cpp = channels(turned);

        zonal::oracle::Matrix3 matrix{};
        std::copy_n(rotation.data(), 9, matrix.begin());
        const auto q = zonal::oracle::nearest_orthonormal(matrix);
        const zonal::oracle::Matrix3 to_light = {q[0], q[3], q[6], q[1], q[4], q[7], q[2], q[5], q[8]};
        const auto one = zonal::banner::bound(order, "rotate");
        const auto three = order > 3 ? zonal::banner::bound(order, "rotate_channels") : one;
        const double relative = std::max(one.float_bound, three.float_bound) +
                                std::max(one.excess, three.excess) * zonal::orthonormality_error(rotation);

        for (int c = 0; c < 3; ++c) {
            const std::vector<zonal::oracle::Real> signal(f[c].begin(), f[c].end());
            const auto wanted = exact(matrix, signal);
            const double allowed = relative * norm(f[c]);
            std::vector<double> to_oracle, to_cpp;
            for (int i = 0; i < count; ++i) {
                to_oracle.push_back(light[i][c] - static_cast<double>(wanted[i]));
                to_cpp.push_back(light[i][c] - cpp[c][i]);
            }
            const auto place = [&] {
                return fmt::format("turn {}, channel {}, norm of the difference", turn, c);
            };
            light_oracle.add(norm(to_oracle), 0, allowed, place);
            light_cpp.add(norm(to_cpp), 0, 2 * allowed, place);
        }
        for (int row = 0; row < scene.size; ++row) {
            for (int column = 0; column < scene.size; ++column) {
                const Pixel& pixel = pixels[static_cast<std::size_t>(row) * scene.size + column];
                const auto hit = zonal::web::hit(scene.size, column, row);
                if (!hit || pixel[3] != 1.0F) {
                    wrong_coverage += pixel == (hit ? Pixel{0, 0, 0, 1} : Pixel{}) ? 0 : 1;
                    continue;
                }
                const auto weights = zonal::web::weights(scene, order, *hit);
                const auto sizes = zonal::web::sizes(scene, order, *hit);
                const auto wanted = zonal::web::colour_by_definition(scene, order, to_light, *hit);
                for (int c = 0; c < 3; ++c) {
                    const double turn_error = relative * norm(f[c]);
                    double by_cpp = 0;
                    double size = 0;
                    for (int i = 0; i < count; ++i) {
                        by_cpp += weights[i] * cpp[c][i];
                        size += sizes[i] * (std::abs(cpp[c][i]) + 2 * turn_error);
                    }
                    const double allowed =
                        norm(weights) * turn_error + zonal::web::shading_error(order) * size;
                    const auto place = [&] {
                        return fmt::format("turn {}, column {}, row {}, channel {}", turn, column, row, c);
                    };
                    pixel_oracle.add(pixel[c], wanted[c], allowed, place);
                    pixel_cpp.add(pixel[c], by_cpp, allowed + norm(weights) * turn_error, place);
                }
            }
        }
    }

    bool report() const {
        fmt::print("order {}: largest difference of {} pictures from\n", order, scene.rotations.size());
        const std::array verdicts = {&light_oracle, &light_cpp, &pixel_oracle, &pixel_cpp};
        for (const auto* verdict : verdicts) verdict->print();
        if (wrong_coverage > 0) fmt::print("  {} pixels are on the ball or off it wrongly\n", wrong_coverage);
        return wrong_coverage == 0 &&
               std::ranges::all_of(verdicts, [](auto* verdict) { return verdict->is_met(); });
    }
};

void compare(const std::filesystem::path& scene_path, const std::filesystem::path& values_path) {
    const Scene scene = zonal::web::read_scene(scene_path);
    const std::size_t pixels = static_cast<std::size_t>(scene.size) * scene.size;
    std::size_t wanted = 0;
    for (const int order : scene.orders) wanted += scene.rotations.size() * (order * order + pixels);
    const std::vector<Pixel> values = read_values(values_path, wanted);
    std::span<const Pixel> rest = values;
    bool is_met = true;
    for (const int order : scene.orders) {
        Judge judge{.scene = scene, .order = order};
        for (std::size_t turn = 0; turn < scene.rotations.size(); ++turn) {
            const std::size_t count = order * order;
            judge.picture(static_cast<int>(turn), rest.first(count), rest.subspan(count, pixels));
            rest = rest.subspan(count + pixels);
        }
        is_met = judge.report() && is_met;
    }
    std::fflush(stdout);  // before the error
    if (!is_met)
        throw std::runtime_error("the browser's pictures differ from C++ by more than rounding explains");
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Writes the scene of tests/web/lit_sphere.html, and judges its pictures.",
                 "zonal-lit-sphere");
    app.require_subcommand(1);
    std::filesystem::path map, scene, values;
    auto* write = app.add_subcommand("scene", "projects a map and writes a scene");
    write->add_option("--map", map, "latitude-longitude map, OpenEXR or Radiance .hdr")->required();
    write->add_option("--out", scene, "scene.json")->required();
    auto* judge = app.add_subcommand("compare", "compares the browser's values with C++ and the oracle");
    judge->add_option("scene", scene, "scene.json")->required();
    judge->add_option("values", values, "values.f32, as render.mjs writes it")->required();
    return zonal::program::run(app, argc, argv, [&] {
        if (write->parsed()) zonal::web::write_scene(zonal::web::scene_of_map(map), scene);
        if (judge->parsed()) compare(scene, values);
    });
}
