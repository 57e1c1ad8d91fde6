#include "kernels/angle_powers.hpp"

#include <fmt/format.h>

namespace zonal::kernels {

using graph::Number;
using graph::Value;

namespace {

/// "cos_3alpha"
std::string name_of(const char* function, int m, const std::string& angle) {
    return fmt::format("{}_{}{}", function, m == 1 ? "" : std::to_string(m), angle);
}

}  // namespace

AnglePowers::AnglePowers(graph::Kernel& kernel, std::string name, Value cosine, Value sine, PowerChain chain,
                         bool only_odd_above_2)
    : kernel_(kernel), name_(std::move(name)), chain_(chain), only_odd_above_2_(only_odd_above_2) {
    powers_[1] = {cosine, sine};
}

Value AnglePowers::twice_cosine(int m) {
    const auto known = twice_cosines_.find(m);
    if (known != twice_cosines_.end()) return known->second;
    const auto made = [&] {
        // 2c_2 without c_2, which is not always wanted.
        if (m == 2) {
            const Value d = twice_cosine(1), step = step_to(2);
            kernel_.graph.set_scope(name_);
            return d * step + Number(-2);
        }
        const Value c = cosine(m);
        kernel_.graph.set_scope(name_);
        return c + c;
    };
    const Value value = made();
    kernel_.graph.set_name(value.id, name_of("twice_cos", m, name_));
    return twice_cosines_[m] = value;
}

Value AnglePowers::twice_sine(int m) {
    const auto known = twice_sines_.find(m);
    if (known != twice_sines_.end()) return known->second;
    kernel_.graph.set_scope(name_);
    const Value value = sine(m) + sine(m);
    kernel_.graph.set_name(value.id, name_of("twice_sin", m, name_));
    return twice_sines_[m] = value;
}

// With c, s = √n (cos θ, sin θ): (2c/n) √n cos (m-1)θ - cos (m-2)θ = cos mθ and 2c cos (m-1)θ - √n cos (m-2)θ
// = √n cos mθ, for sines alike. So steps by 2c/n and by 2c in turn keep even powers at norm 1 and odd ones at
// √n. To first order 1/n is 1 + the defect.
Value AnglePowers::step_to(int m) {
    const Value d = twice_cosine(1);
    if (norm_defect_.graph == nullptr || m % 2 == 1) return d;
    if (!step_to_even_) {
        kernel_.graph.set_scope(name_);
        step_to_even_ = norm_defect_ * d + d;
        kernel_.graph.set_name(step_to_even_->id, name_of("twice_cos", 1, name_) + "_over_n");
    }
    return *step_to_even_;
}

AnglePowers::Power AnglePowers::power(int m) {
    const auto known = powers_.find(m);
    if (known != powers_.end()) return known->second;
    const Power made = make(m);
    kernel_.graph.set_name(made.cosine.id, name_of("cos", m, name_));
    kernel_.graph.set_name(made.sine.id, name_of("sin", m, name_));
    return powers_[m] = made;
}

AnglePowers::Power AnglePowers::make(int m) {
    // One product a line: see graph::Value.
    if (m == 2) {
        const Value d = step_to(2);
        kernel_.graph.set_scope(name_);
        const Value sine = d * powers_[1].sine;
        return {d * powers_[1].cosine + Number(-1), sine};
    }
    if (chain_ == PowerChain::recurrence) {
        if (only_odd_above_2_ && m % 2 == 1) {
            // c_m = 2c_2 c_{m-2} - c_{m-4}, where c_{-1} = c_1 and s_{-1} = -s_1.
            const Value e = twice_cosine(2);
            const Power last = power(m - 2), before = m == 3 ? power(1) : power(m - 4);
            kernel_.graph.set_scope(name_);
            const Value cosine = e * last.cosine - before.cosine;
            const Value product = e * last.sine;
            return {cosine, m == 3 ? product + before.sine : product - before.sine};
        }
        const Value d = step_to(m);
        const Power last = power(m - 1), before = power(m - 2);
        kernel_.graph.set_scope(name_);
        const Value cosine = d * last.cosine - before.cosine;
        const Value sine = d * last.sine - before.sine;
        return {cosine, sine};
    }
    const Power a = power(m / 2), b = power(m - m / 2);
    kernel_.graph.set_scope(name_);
    const Value ss = a.sine * b.sine;
    const Value cosine = a.cosine * b.cosine - ss;
    if (m % 2 == 0) {
        const Value sine = twice_cosine(m / 2) * a.sine;
        return {cosine, sine};
    }
    const Value cs = a.cosine * b.sine;
    return {cosine, a.sine * b.cosine + cs};
}

}  // namespace zonal::kernels
