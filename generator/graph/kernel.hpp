#pragma once

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "graph/cost.hpp"
#include "graph/graph.hpp"

namespace zonal::graph {

/// An argument of a kernel.
struct Array {
    std::string name;
    Kind kind = Kind::signal;
    int size = 0;
    std::string comment;  ///< what it holds: layout and units
};

/// One element of the output. Stores of a group happen together, after all reads of that group: a kernel may
/// write over its input as long as no later group reads what an earlier one wrote.
struct Store {
    int index = 0;
    Id value = -1;
    int group = 0;
    /// For machines where few values may wait: steps, one after another, that store what is alike in what it
    /// needs. A kernel has them, instead of its groups, where they differ.
    int step = 0;
};

/// What C++ prints in place of straight lines, where those are too many.
struct Loops {
    std::string support;       ///< name of the header that the body calls
    std::string support_text;  ///< what stands in it, in namespace kernel_support
    std::string body;          ///< statements, indented by four
    Cost cost;                 ///< of the loops
};

/// One function to emit: its graph, its arguments and what its comment says.
struct Kernel {
    std::string name;
    std::string variant;               ///< the namespace inside the unit's own that holds it; empty: none
    std::string summary;               ///< what it computes, one or two lines
    std::vector<std::string> sources;  ///< author, year, equation; one a method
    std::vector<Array> inputs;
    Array output;
    Graph graph;
    std::vector<Store> stores;
    bool needs_proper_rotation = false;  ///< right for determinant +1 only
    /// The kernel to call instead where a signal value holds several channels; empty: this one.
    std::string for_channels;
    bool is_for_channels = false;  ///< languages with overloads give it the name of the kernel that it serves
    /// The kernel of the same graph that a language with functions calls instead of repeating the body;
    /// empty: none.
    std::string forwards_to;
    std::optional<Loops> loops;
    bool needs_lobes = false;  ///< built from a lobe table
    bool has_bound = false;    ///< an error bound is published for it

    /// By which banners, counts and bounds call it: "rotate_zhf", "stable::rotate_zhf".
    std::string full_name() const { return variant.empty() ? name : variant + "::" + name; }

    /// Whether an argument is of this kind.
    bool uses(Kind kind) const {
        const auto is_of_kind = [&](const Array& array) { return array.kind == kind; };
        return is_of_kind(output) || std::any_of(inputs.begin(), inputs.end(), is_of_kind);
    }

    bool has_steps() const {
        return std::any_of(stores.begin(), stores.end(), [](const Store& store) { return store.step != 0; });
    }

    Value input(int array, int index) { return {&graph, graph.input(inputs[array].kind, array, index)}; }
    void store(int index, Value value, int group, int step = 0) {
        stores.push_back({index, value.id, group, step});
    }
};

/// The kernel of that full name. Throws std::logic_error where there is none.
inline const Kernel& kernel_named(const std::vector<Kernel>& kernels, const std::string& full_name) {
    for (const Kernel& kernel : kernels)
        if (kernel.full_name() == full_name) return kernel;
    throw std::logic_error("no kernel " + full_name);
}

}  // namespace zonal::graph
