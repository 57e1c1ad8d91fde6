#include "web/scene.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <stdexcept>

#include "zonal/eigen.hpp"
#include "zonal/environment_map.hpp"
#include "zonal/projection.hpp"

namespace zonal::web {
namespace {

constexpr int kSize = 128;
constexpr int kTurns = 4;
constexpr double kStepDegrees = 80;  // no symmetry of a cube
/// Linear value at which the mean of the map is shown.
constexpr double kMiddleGrey = 0.2;

}  // namespace

Scene scene_of_map(const std::filesystem::path& map) {
    Scene scene{.size = kSize, .orders = {3, 4}, .matte = 0.75, .mirror = 0.25};
    const int order = std::ranges::max(scene.orders);
    for (const auto& value : project(order, read_environment_map(map))) {
        scene.light.push_back(value.cast<float>());
    }
    const Rgb<float>& mean = scene.light.front();
    scene.exposure =
        static_cast<float>(kMiddleGrey * std::sqrt(4 * std::numbers::pi) * 3 / (mean.r + mean.g + mean.b));
    const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, 3).normalized();
    for (int turn = 0; turn < kTurns; ++turn) {
        const double angle_rad = turn * kStepDegrees * std::numbers::pi / 180;
        scene.rotations.emplace_back(Eigen::AngleAxisd(angle_rad, axis));
    }
    return scene;
}

void write_scene(const Scene& scene, const std::filesystem::path& path) {
    nlohmann::json light, rotations;
    for (const auto& value : scene.light) light.push_back({value.r, value.g, value.b});
    for (const auto& rotation : scene.rotations) {
        rotations.push_back(std::vector<float>(rotation.data(), rotation.data() + 9));
    }
    const nlohmann::json json = {{"size", scene.size},         {"orders", scene.orders},
                                 {"matte", scene.matte},       {"mirror", scene.mirror},
                                 {"exposure", scene.exposure}, {"light", light},
                                 {"rotations", rotations}};
    std::ofstream file(path);
    if (!(file << json.dump() << '\n')) {
        throw std::runtime_error(fmt::format("{}: cannot be written; choose another place", path.string()));
    }
}

Scene read_scene(const std::filesystem::path& path) try {
    std::ifstream file(path);
    const nlohmann::json json = nlohmann::json::parse(file);
    Scene scene;
    json.at("size").get_to(scene.size);
    json.at("orders").get_to(scene.orders);
    json.at("matte").get_to(scene.matte);
    json.at("mirror").get_to(scene.mirror);
    json.at("exposure").get_to(scene.exposure);
    for (const auto& value : json.at("light")) {
        scene.light.push_back({value.at(0).get<float>(), value.at(1).get<float>(), value.at(2).get<float>()});
    }
    for (const auto& values : json.at("rotations")) {
        Eigen::Matrix3f matrix;
        for (int i = 0; i < 9; ++i) matrix(i / 3, i % 3) = values.at(i).get<float>();
        scene.rotations.emplace_back(matrix);
    }
    return scene;
} catch (const nlohmann::json::exception& problem) {
    throw std::runtime_error(fmt::format("{}: found {}; wanted a scene, as zonal-lit-sphere scene writes it",
                                         path.string(), problem.what()));
}

}  // namespace zonal::web
