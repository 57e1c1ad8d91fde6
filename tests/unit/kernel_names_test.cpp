// What values of the rotation are called is what they are.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "graph/evaluate.hpp"
#include "kernels/order_kernels.hpp"

namespace {

using zonal::graph::Kernel;

/// Every named value of a kernel at a rotation.
std::map<std::string, double> named_values(Kernel kernel, const std::vector<double>& R) {
    std::vector<std::string> names;
    kernel.stores.clear();
    for (int id = 0; id < kernel.graph.size(); ++id) {
        if (kernel.graph[id].name.empty()) continue;
        kernel.stores.push_back({static_cast<int>(names.size()), id, 0});
        names.push_back(kernel.graph[id].name);
    }
    const std::vector<double> signal(kernel.output.size, 0);
    std::vector<double> values(names.size());
    zonal::graph::Evaluator<double> evaluate(kernel);
    evaluate({R.data(), signal.data()}, values.data());
    std::map<std::string, double> by_name;
    for (std::size_t k = 0; k < names.size(); ++k) by_name[names[k]] = values[k];
    return by_name;
}

TEST(KernelNames, tell_the_angle_the_function_and_the_sign) {
    const std::map<std::string, double> angles{{"alpha", 0.7}, {"beta", 1.1}, {"gamma", -0.4}};
    const double ca = std::cos(0.7), sa = std::sin(0.7), cb = std::cos(1.1), sb = std::sin(1.1),
                 cg = std::cos(-0.4), sg = std::sin(-0.4);
    // Rz(alpha) Ry(beta) Rz(gamma)
    const std::vector<double> R{ca * cb * cg - sa * sg,
                                -ca * cb * sg - sa * cg,
                                ca * sb,
                                sa * cb * cg + ca * sg,
                                -sa * cb * sg + ca * cg,
                                sa * sb,
                                -sb * cg,
                                sb * sg,
                                cb};
    const std::regex pattern("(minus_)?(twice_)?(cos|sin)_([0-9]*)(alpha|beta|gamma)(_over_n)?");
    for (const int order : {4, 6, 10}) {
        std::set<std::string> judged;
        const auto kernels = zonal::build_order_kernels(order).kernels;
        for (const auto& [name, value] :
             named_values(zonal::graph::kernel_named(kernels, "rotate_fewest"), R)) {
            std::smatch part;
            if (!std::regex_match(name, part, pattern)) continue;
            const double angle = angles.at(part[5]) * (part[4].length() == 0 ? 1 : std::stoi(part[4]));
            const double sign = part[1].matched ? -1 : 1, factor = part[2].matched ? 2 : 1;
            const double wanted = sign * factor * (part[3] == "cos" ? std::cos(angle) : std::sin(angle));
            EXPECT_NEAR(value, wanted, 1e-13) << "order " << order << ": " << name;
            judged.insert(part[5]);
        }
        EXPECT_EQ(judged, (std::set<std::string>{"alpha", "beta", "gamma"})) << order;
    }
}

}  // namespace
