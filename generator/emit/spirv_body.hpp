#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "graph/kernel.hpp"

namespace zonal::emit {

/// How a module's signal values and arithmetic are.
struct SpirvForm {
    bool has_channels = false;  ///< three a signal value
    bool is_precise = false;    ///< products and sums are never contracted
};

/// The types and constants that a module uses, each declared once, in the order they were asked for.
class SpirvDeclarations {
  public:
    SpirvDeclarations();
    std::string type(const std::string& name, const std::string& definition);
    std::string unsigned_integer(unsigned value);
    std::string number(const std::string& digits);
    const std::string& text() const { return text_; }

  private:
    std::string text_;
    std::set<std::string> names_;
    std::map<std::string, std::string> numbers_;  ///< by their digits
};

/// Where a kernel's arrays are.
class SpirvMemory {
  public:
    virtual ~SpirvMemory() = default;
    /// Instructions that make %name the value at `index` of an input.
    virtual std::string load(int input, int index, const std::string& name) = 0;
    virtual std::string store(int index, const std::string& value) = 0;
};

/// Instructions, and identifiers of the values that no compiler may contract or reassociate.
struct SpirvBody {
    std::string text;
    std::vector<std::string> fixed_results;
};

/// The arithmetic of a kernel, and its loads and stores, in an order that holds few registers.
SpirvBody print_spirv_body(const graph::Kernel& kernel, const SpirvForm& form,
                           SpirvDeclarations& declarations, SpirvMemory& memory);

}  // namespace zonal::emit
