#include "gpu/reference.hpp"

#include <map>
#include <stdexcept>

namespace zonal::gpu {

namespace {

std::map<int, std::vector<ReferenceKernel>>& all_kernels() {
    static std::map<int, std::vector<ReferenceKernel>> all;
    return all;
}

}  // namespace

const std::vector<ReferenceKernel>& reference_kernels(int order) { return all_kernels().at(order); }

const ReferenceKernel& reference_kernel(int order, const std::string& name) {
    for (const ReferenceKernel& kernel : reference_kernels(order))
        if (kernel.name == name) return kernel;
    throw std::out_of_range("order " + std::to_string(order) + " has no kernel " + name);
}

std::vector<int> reference_orders() {
    std::vector<int> orders;
    for (const auto& [order, kernels] : all_kernels()) orders.push_back(order);
    return orders;
}

bool add_reference_kernels(int order, std::vector<ReferenceKernel> kernels) {
    return all_kernels().emplace(order, std::move(kernels)).second;
}

}  // namespace zonal::gpu
