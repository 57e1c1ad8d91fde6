#include "targets.hpp"

#include <hwy/targets.h>

#include <algorithm>
#include <atomic>
#include <cstdint>

#include "target_list.hpp"

namespace zonal::batch {

#define ZONAL_BATCH_TARGET(name, highway_target) \
    KernelTable<float> name##_float();           \
    KernelTable<double> name##_double();
ZONAL_FOR_EACH_BATCH_TARGET(ZONAL_BATCH_TARGET)
#undef ZONAL_BATCH_TARGET

namespace {

struct Target {
    std::string_view name;
    std::int64_t highway_target;  ///< 0: runs everywhere
    KernelTable<float> (*single)();
    KernelTable<double> (*twice)();
};

#define ZONAL_BATCH_TARGET(name, highway_target) {#name, highway_target, name##_float, name##_double},
constexpr Target kTargets[] = {ZONAL_FOR_EACH_BATCH_TARGET(ZONAL_BATCH_TARGET)};
#undef ZONAL_BATCH_TARGET

bool runs_here(const Target& target) {
    return target.highway_target == 0 || (hwy::SupportedTargets() & target.highway_target) != 0;
}

const Target* best_target() { return std::ranges::find_if(kTargets, runs_here); }

std::atomic<const Target*>& chosen() {
    static std::atomic<const Target*> target(best_target());
    return target;
}

std::atomic<std::size_t> streamed(kStreamedBytes);

}  // namespace

std::size_t streamed_bytes() { return streamed; }

void set_streamed_bytes(std::size_t bytes) { streamed = bytes; }

std::vector<std::string_view> runnable_targets() {
    std::vector<std::string_view> names;
    for (const Target& target : kTargets)
        if (runs_here(target)) names.push_back(target.name);
    return names;
}

bool choose_target(std::string_view name) {
    if (name.empty()) {
        chosen() = best_target();
        return true;
    }
    for (const Target& target : kTargets) {
        if (target.name != name || !runs_here(target)) continue;
        chosen() = &target;
        return true;
    }
    return false;
}

std::string_view chosen_target() { return chosen().load()->name; }

template <>
KernelTable<float> kernels<float>() {
    return chosen().load()->single();
}

template <>
KernelTable<double> kernels<double>() {
    return chosen().load()->twice();
}

}  // namespace zonal::batch
