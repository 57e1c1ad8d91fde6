#include "graph/counts.hpp"

namespace zonal::graph {

Cost count_operations(const Kernel& kernel, const std::string& scope) {
    Cost cost;
    for (Id id = 0; id < kernel.graph.size(); ++id) {
        const Node& node = kernel.graph[id];
        if (!node.scope.starts_with(scope)) continue;
        Counts& counts = node.kind == Kind::signal ? cost.per_vector : cost.per_rotation;
        switch (node.op) {
            case Op::multiply:
                ++counts.mul;
                break;
            case Op::add:
            case Op::subtract:
                ++counts.add;
                break;
            case Op::fused:
                ++counts.fma;
                break;
            case Op::divide:
            case Op::square_root:
                ++counts.other;
                break;
            case Op::copy_sign:
            case Op::constant:
            case Op::input:
            case Op::negate:
                break;
        }
    }
    return cost;
}

}  // namespace zonal::graph
