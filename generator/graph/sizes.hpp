#pragma once

#include <map>
#include <utility>
#include <vector>

#include "graph/graph.hpp"

namespace zonal::graph {

/// Numbers the sizes |factor| != 0 of constants in the order they are met, 1 before all others. Sizes that
/// differ in their last digits only are one, so that a search can compare whole numbers.
class Sizes {
  public:
    static constexpr int kUnit = 0;  ///< the size 1

    Sizes();
    /// Precondition: factor != 0.
    int number_of(const Number& factor);
    /// The number of [a] / [b].
    int quotient(int a, int b);
    /// The size as it was first met; 1 exactly.
    const Number& operator[](int number) const { return sizes_[number]; }
    int count() const { return static_cast<int>(sizes_.size()); }

  private:
    std::vector<Number> sizes_;
    std::map<Number, int> numbers_;
    std::map<std::pair<int, int>, int> quotients_;  ///< those asked for before
};

}  // namespace zonal::graph
