#pragma once

#include <string>

#include "graph/program.hpp"

namespace zonal::emit {

/// The loops that table-driven kernels call: a header of their own.
extern const char* const kTableLoops;

/// A kernel as loops over tables: the operations of its graph, and far less text than a line for each.
class TablePrinter {
  public:
    /// `name`: of the kernel, in PascalCase.
    TablePrinter(const graph::Kernel& kernel, std::string name);

    /// What stands in front of the function.
    std::string tables() const;
    std::string body(int indentation) const;

  private:
    /// One call of a loop: where its rows begin in the table, and the name of its operation.
    struct Call {
        const graph::Loop* loop = nullptr;
        std::size_t first_entry = 0;
        std::string operation;
    };
    std::string print_call(const Call& call, const std::string& indentation) const;
    std::string operation(const graph::Loop& loop) const;
    const char* type_of(const graph::Place& place) const;
    std::string array_of(const graph::Place& place) const;

    const graph::Kernel& kernel_;
    std::string name_;
    graph::Program program_;
};

}  // namespace zonal::emit
