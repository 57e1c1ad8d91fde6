#pragma once

#include <map>
#include <optional>
#include <string>

#include "graph/kernel.hpp"

namespace zonal::kernels {

/// How cos mθ and sin mθ are made.
enum class PowerChain {
    /// c_m = 2c_1 c_{m-1} - c_{m-2}, or steps of two where every second one is wanted: two instructions a
    /// power; an error of the base's norm grows as m². For m <= 5.
    recurrence,
    /// (c + is)^{a+b} = (c + is)^a (c + is)^b with a, b about m/2: four instructions a power; an error of the
    /// base
    /// grows as m, since multiplying by a number of size 1 enlarges nothing.
    product,
};

/// Cosine and sine of the multiples of one angle, made when first asked for.
class AnglePowers {
  public:
    /// `only_odd_above_2`: chains step by two from m = 3 on.
    AnglePowers(graph::Kernel& kernel, std::string name, graph::Value cosine, graph::Value sine,
                PowerChain chain, bool only_odd_above_2);
    /// Tells 1 - c² - s² of a base whose norm is not 1. Even powers are then made of norm 1, and odd ones
    /// keep the norm of the base, where it would grow in both.
    void set_norm_defect(graph::Value value) { norm_defect_ = value; }

    /// m >= 1.
    graph::Value cosine(int m) { return power(m).cosine; }
    graph::Value sine(int m) { return power(m).sine; }
    graph::Value twice_cosine(int m);
    graph::Value twice_sine(int m);

  private:
    struct Power {
        graph::Value cosine, sine;
    };
    Power power(int m);
    Power make(int m);
    /// 2c_1, over c² + s² for even powers.
    graph::Value step_to(int m);

    graph::Kernel& kernel_;
    std::string name_;
    PowerChain chain_;
    bool only_odd_above_2_;
    graph::Value norm_defect_;  ///< graph: null where the norm is 1
    std::map<int, Power> powers_;
    std::map<int, graph::Value> twice_cosines_, twice_sines_;
    std::optional<graph::Value> step_to_even_;
};

}  // namespace zonal::kernels
